// Whole files in and out for the picture formats: a file that appears under its name is complete.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace render {

// Written beside its destination and renamed over it by commit(), so a write that fails or is cut
// short leaves what was there. Without commit() the destructor removes it.
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
    std::filesystem::path destination_;
    std::filesystem::path partial_;
    std::unique_ptr<std::FILE, Close> stream_;
};

// Throws ImageError.
std::vector<std::byte> readPictureFile(const std::filesystem::path&);

}  // namespace render
