#include "timeseries/ordinary_file.h"

namespace timeseries {

std::string flawOfFile(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) return "expected a file, but there is none";
    if (std::filesystem::is_directory(status)) return "expected a file, but it is a folder";
    if (!std::filesystem::is_regular_file(status)) return "expected an ordinary file";
    return "";
}

}  // namespace timeseries
