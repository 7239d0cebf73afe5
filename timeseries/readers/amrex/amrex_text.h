// The text of AMReX's headers: blanks and lines apart words, numbers and boxes of indices, written
// as ((0,0,0) (31,31,31) (0,0,0)), the least, the greatest, and along which axes they are nodes.
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

#include "timeseries/grid/index_boxes.h"

namespace timeseries {

// Every function that takes more than blanks throws FileError where something else stands there.
class AmrexText {
 public:
    // The stream stays. Sentences begin with `place`, and tell the line where that is one of many.
    AmrexText(std::istream& from, std::string place, bool hasLines = true)
        : from_(*from.rdbuf()), place_(std::move(place)), hasLines_(hasLines) {}

    std::string word(std::string_view what);
    std::string restOfLine();  // without blanks about it
    std::int64_t integer(std::string_view what, std::int64_t least, std::int64_t most);
    double number(std::string_view what);  // finite
    // Passes this character, behind blanks.
    void expect(char c);
    bool isNext(char c);
    // Of cells, with one index 0 for each axis that there is not; indices within 2^30.
    IndexBox box(std::size_t dimensions);

    std::uint64_t taken() const { return taken_; }  // characters
    [[noreturn]] void fail(std::string_view expected) const;

 private:
    int peek();
    void take();
    void skipBlanks();
    std::array<std::int64_t, 3> indices(std::size_t dimensions);

    std::streambuf& from_;
    const std::string place_;
    const bool hasLines_;
    std::uint64_t line_ = 1, taken_ = 0;
};

}  // namespace timeseries
