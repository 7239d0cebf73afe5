// Whole files in and out for the picture formats: a file that appears under its name is complete.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace render {

// Written beside its destination and renamed over it by commit(), so a write that fails or is cut
// short leaves what was there. Without commit() the destructor removes it. What is no file, as a
// pipe or /dev/stdout, is written into.
class PartialFile {
 public:
    // Throws ImageError.
    explicit PartialFile(std::filesystem::path destination);
    ~PartialFile();
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;

    std::FILE* stream() { return stream_.get(); }
    void commit();  // once; throws ImageError

 private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path destination_, target_;  // as it was named, and where links lead
    std::filesystem::path partial_;               // empty where it is written into
    std::unique_ptr<std::FILE, Close> stream_;
};

// Throws ImageError.
std::vector<std::byte> readPictureFile(const std::filesystem::path&);

}  // namespace render
