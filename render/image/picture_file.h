// Whole files in and out for the picture formats: a file that appears under its name is complete.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace render {

// Written beside its destination and renamed over it by commit(), so a write that fails or is cut
// short leaves what was there. Without commit() the destructor removes it, and the next one that of
// a program that was ended. What is no file, as a pipe or /dev/stdout, is written into.
class PartialFile {
 public:
    // What a number behind makes of the destination's name until then.
    static constexpr const char* kSuffix = ".isochron-part";
    // Throws ImageError.
    explicit PartialFile(std::filesystem::path destination);
    ~PartialFile();
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;

    std::FILE* stream() { return stream_.get(); }
    void commit();  // once; throws ImageError

    // Of a file beside its destination, what the destination is called; empty where it is none.
    static std::filesystem::path destinationOf(const std::filesystem::path& partial);
    // What a program has left that was ended; one that somebody writes stays.
    static void removeLeft(const std::filesystem::path& partial);
    // From now on a signal that ends the program (SIGINT, SIGTERM, SIGHUP) leaves none of what it
    // is writing.
    static void leaveNoneWhenEnded();

 private:
    void keepInMind();
    void forget();
    int openPartial();  // -1: errno tells why not
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path destination_, target_;  // as it was named, and where links lead
    std::filesystem::path partial_;               // empty where it is written into
    std::unique_ptr<std::FILE, Close> stream_;
    int locked_ = -1;  // the partial file, locked until it has its name
};

// By how its name ends, in capitals or not.
bool isPng(const std::filesystem::path& file);
bool isExr(const std::filesystem::path& file);

// Throws ImageError.
std::vector<std::byte> readPictureFile(const std::filesystem::path&);

}  // namespace render
