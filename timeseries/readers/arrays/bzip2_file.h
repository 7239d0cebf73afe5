// A bzip2 file, decoded from some place on: one stream, or several behind each other, as pbzip2 and
// `cat` make them. bzlib's own file functions end with the first.
#pragma once

#include <bzlib.h>

#include <cstddef>
#include <vector>

namespace timeseries {

class Bzip2File {
 public:
    // Begins where the descriptor stands, and reads on from there. REQUIRES: `file` outlives this,
    // and nobody else moves it. Throws std::bad_alloc.
    explicit Bzip2File(int file);
    ~Bzip2File();
    Bzip2File(const Bzip2File&) = delete;
    Bzip2File& operator=(const Bzip2File&) = delete;

    // The next decoded bytes; fewer at the end of the last stream, -1 where one is damaged or cut.
    // What follows a stream without beginning another is passed over, as bzip2 and gzip do.
    std::ptrdiff_t read(char* out, std::size_t bytes);

 private:
    bool begin();
    bool decode();
    void take(std::size_t enough);

    int file_;
    std::vector<char> packed_;
    bz_stream stream_{};  // its input lies in packed_
    bool inStream_ = false, fileEnds_ = false;
};

}  // namespace timeseries
