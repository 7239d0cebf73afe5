#include "timeseries/readers/kept_readers.h"

#include <algorithm>
#include <utility>

namespace timeseries {

constexpr std::size_t kMostOpen = 3;

WrittenAt writtenAt(const std::filesystem::path& path) {
    std::error_code fails;  // what is not there is told by who opens it
    const std::uintmax_t bytes = std::filesystem::file_size(path, fails);
    if (fails) return {};
    return {bytes, std::filesystem::last_write_time(path, fails)};
}

Reader* KeptReaders::find(std::size_t file, const WrittenAt& at) {
    const auto found = std::ranges::find(open_, file, &Open::file);
    if (found != open_.end() && found->at == at) {
        open_.splice(open_.begin(), open_, found);
        return open_.front().reader.get();
    }
    if (found != open_.end()) open_.erase(found);
    if (open_.size() == kMostOpen) open_.pop_back();
    return nullptr;
}

Reader& KeptReaders::keep(std::size_t file, const WrittenAt& at, std::unique_ptr<Reader> reader) {
    open_.push_front({file, at, std::move(reader)});
    return *open_.front().reader;
}

}  // namespace timeseries
