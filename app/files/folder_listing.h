// What a folder holds that can be opened, found on a thread of its own: folders may be slow.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace app {

struct FolderEntry {
    std::filesystem::path path;
    bool isFolder = false;
};

struct FolderContents {
    std::vector<FolderEntry> entries;  // folders first, then by name; hidden ones left out
    std::string why;                   // one sentence when it could not be read
};

// A folder to look into: none that is a data set itself.
bool isFolder(const std::filesystem::path& path);

// Sessions and pictures are told by their names, data files by their beginnings.
bool opens(const std::filesystem::path& file);

// Dropping it forgets the thread, as Opening does.
class FolderListing {
 public:
    // `all`: files that cannot be opened too. `wake` is called from the other thread, also after
    // this is gone.
    FolderListing(std::filesystem::path folder, bool all, std::function<void()> wake);

    // None until it is there.
    std::optional<FolderContents> poll();

 private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
};

}  // namespace app
