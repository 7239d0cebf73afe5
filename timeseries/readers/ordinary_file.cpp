#include "timeseries/readers/ordinary_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

std::string notReadable(const std::error_code& why) {
    return "expected a file that can be read, but " + why.message();
}

}  // namespace

std::string flawOfFile(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        return "expected a file, but there is none";
    if (error) return notReadable(error);
    if (std::filesystem::is_directory(status)) return "expected a file, but it is a folder";
    if (!std::filesystem::is_regular_file(status)) return "expected an ordinary file";
    if (access(path.c_str(), R_OK) != 0) return notReadable({errno, std::generic_category()});
    return "";
}

void expectFile(const std::filesystem::path& path) {
    if (const std::string flaw = flawOfFile(path); !flaw.empty())
        throw FileError(fmt::format("{}: {}", path.string(), flaw));
}

}  // namespace timeseries
