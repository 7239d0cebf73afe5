#include "render/image/picture_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "render/image/image.h"

namespace render {

namespace {

std::string lastError() { return std::generic_category().message(errno); }

}  // namespace

PartialFile::PartialFile(std::filesystem::path destination) : destination_(std::move(destination)) {
    // A link stays, and what it leads to is replaced; one that leads nowhere is replaced itself.
    std::error_code none;
    target_ = destination_;
    if (std::filesystem::is_symlink(destination_, none))
        if (auto led = std::filesystem::canonical(destination_, none); !none)
            target_ = std::move(led);
    if (const auto there = std::filesystem::status(target_, none);
        std::filesystem::exists(there) && !std::filesystem::is_regular_file(there) &&
        !std::filesystem::is_directory(there)) {  // a device or a pipe is written into
        stream_.reset(std::fopen(target_.c_str(), "wbe"));
        if (!stream_) throw ImageError(destination_, "cannot be written: " + lastError());
        return;
    }
    // O_EXCL: two programs writing the same picture never share a partial file.
    constexpr int kAttempts = 100;
    int descriptor = -1;
    for (int n = 0; descriptor < 0 && n < kAttempts; ++n) {
        partial_ = target_;
        partial_ += ".part" + std::to_string(n);
        descriptor = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) throw ImageError(destination_, "cannot be created: " + lastError());
    stream_.reset(::fdopen(descriptor, "wb"));
    if (stream_) return;
    const std::string why = lastError();
    ::close(descriptor);
    ::unlink(partial_.c_str());
    throw ImageError(destination_, "cannot be written: " + why);
}

PartialFile::~PartialFile() {
    if (!partial_.empty()) ::unlink(partial_.c_str());
}

void PartialFile::commit() {
    // A full disk may show only when the last buffer is written, so fclose is checked too.
    errno = 0;
    const bool hadError = std::ferror(stream_.get()) != 0;
    if (std::fclose(stream_.release()) != 0 || hadError) {
        throw ImageError(destination_, "cannot be written: " + lastError());
    }
    if (partial_.empty()) return;
    if (::rename(partial_.c_str(), target_.c_str()) != 0) {
        throw ImageError(destination_, "cannot be replaced: " + lastError());
    }
    partial_.clear();
}

std::vector<std::byte> readPictureFile(const std::filesystem::path& file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);  // fails for a folder
    if (error) throw ImageError(file, "cannot be read: " + error.message());
    std::ifstream in(file, std::ios::binary);
    std::vector<std::byte> bytes(size);
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
        throw ImageError(file, "cannot be read");
    }
    return bytes;
}

}  // namespace render
