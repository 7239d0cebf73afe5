#include "app/files/folder_listing.h"

#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>

#include "app/choices/session.h"
#include "timeseries/readers/reader.h"

namespace app {

namespace fs = std::filesystem;

struct FolderListing::Shared {
    std::mutex mutex;
    std::optional<FolderContents> result;
};

namespace {

FolderContents listed(const fs::path& folder, bool all) {
    FolderContents contents;
    try {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            if (entry.path().filename().string().starts_with('.')) continue;
            std::error_code gone;
            const bool inside = isFolder(entry.path());
            const bool isData = !inside && entry.is_directory(gone);
            if (inside || isData || (entry.is_regular_file(gone) && (all || opens(entry.path()))))
                contents.entries.push_back({entry.path(), inside});
        }
    } catch (const fs::filesystem_error& error) {
        contents.why = folder.string() + ": " + error.code().message();
    }
    std::sort(contents.entries.begin(), contents.entries.end(),
              [](const FolderEntry& a, const FolderEntry& b) {
                  return a.isFolder != b.isFolder ? a.isFolder : a.path < b.path;
              });
    return contents;
}

}  // namespace

bool isFolder(const fs::path& path) {
    std::error_code gone;
    return fs::is_directory(path, gone) && !timeseries::isReadable(path);
}

bool opens(const fs::path& file) {
    if (holdsSession(file)) return true;
    try {
        return timeseries::isReadable(file);
    } catch (const std::exception&) {
        return false;
    }
}

FolderListing::FolderListing(fs::path folder, bool all, std::function<void()> wake)
    : shared_(std::make_shared<Shared>()) {
    std::thread([shared = shared_, folder = std::move(folder), all, wake = std::move(wake)] {
        FolderContents contents = listed(folder, all);
        {
            const std::lock_guard lock(shared->mutex);
            shared->result = std::move(contents);
        }
        wake();
    }).detach();
}

std::optional<FolderContents> FolderListing::poll() {
    const std::lock_guard lock(shared_->mutex);
    return std::exchange(shared_->result, std::nullopt);
}

}  // namespace app
