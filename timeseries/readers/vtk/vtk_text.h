// The words, lines and blocks of values of a legacy VTK file, read in order and held against the
// file's size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "timeseries/readers/vtk/vtk_header.h"

namespace timeseries {

class VtkText {
 public:
    explicit VtkText(const std::filesystem::path& path);

    void setBinary(bool binary) { binary_ = binary; }

    // "line 3" (the lines of binary values are not counted).
    std::string place() const;
    // The rest of the line, without its end. Throws FileError past the end of the file, and when it
    // has more than 255 characters, which VTK would read as two lines.
    std::string line();
    std::string word();  // "" at the end of the file
    std::string lowerWord();
    // A word, in which %20 stands for a blank, and so on. Throws FileError when there is none.
    std::string name();
    std::string decoded(std::string_view name) const;
    std::uint64_t count(std::string_view what);
    double number(std::string_view what);
    // Up to a blank line or the end of the file.
    void skipParagraph();
    // Values in the file's own form, after the rest of the line when they are binary. Throw
    // FileError when there are fewer, or words that are no numbers of the type.
    void skipNumbers(const VtkType& type, std::uint64_t count);
    std::vector<double> numbers(const VtkType& type, std::uint64_t count);
    void skipBytesOrWords(std::uint64_t bytes, std::uint64_t words);
    void skipStrings(std::uint64_t count);

    [[noreturn]] void fail(std::string_view what) const;

 private:
    int next();  // -1 at the end
    void checkCodes(std::string_view word) const;
    // How many characters of the rest of the line are not blank; none when the file ends in it.
    std::optional<std::size_t> skipEncodedLine();
    // To the line behind this one, which so many bytes of values begin.
    void beginBytes(std::uint64_t bytes);
    // Throws FileError when the file is too small for so many words.
    void checkWords(std::uint64_t count) const;

    std::filesystem::path path_;
    std::uint64_t bytes_ = 0;
    std::ifstream file_;
    std::uint64_t line_ = 1;
    bool binary_ = false;
};

}  // namespace timeseries
