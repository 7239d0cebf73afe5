// One file of an OpenFOAM case, read from its beginning to its end: text, in which lists of numbers
// may be binary; packed by gzip or not. OpenFOAM, "User Guide", 2.2 "Basic input/output file
// format"; what a binary list is, its Istream::read and CompactIOList say.
#pragma once

#include <zlib.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace timeseries {

// The entries of FoamFile.
struct FoamHeader {
    std::string className;  // "volScalarField"
    bool isBinary = false;
    std::uint64_t labelBytes = 4, scalarBytes = 8;  // as `arch` says, 4 or 8
    bool hasArch = false;
};

// The file of a name, or with .gz behind it where only that is there.
std::filesystem::path foamPath(const std::filesystem::path& folder, const std::string& name);

// Throws FileError from all of its functions: the file, the line (in binary files the byte), what
// was expected. Holds a buffer, never a whole file.
class FoamFile {
 public:
    explicit FoamFile(std::filesystem::path path);

    const FoamHeader& header() const { return header_; }

    // A bracket, a semicolon, a quoted string with its quotes, or a word; "" at the end. To be used
    // until the next call of any function.
    std::string_view next();
    // Passes the next token, if it is this.
    bool take(std::string_view token);
    void expect(std::string_view token);
    // Passes an entry of a dictionary behind its keyword, up to its semicolon or closing brace.
    void skipEntry();

    // A list's numbers, each in [least, end), -1 as kNoPoint. At most so many.
    std::vector<std::uint32_t> labels(std::int64_t least, std::uint64_t end, std::uint64_t most);
    // A list of rows of so many scalars, of binary ones no wider than T. So many rows; one for all
    // only where `least` is `most`.
    template <std::floating_point T>
    std::vector<T> rows(std::uint64_t components, std::uint64_t least, std::uint64_t most);
    // One row, as text.
    template <std::floating_point T>
    void row(std::uint64_t components, T* out);
    // Lists of labels, one behind the other, and where each ends.
    struct Lists {
        std::vector<std::uint64_t> ends;
        std::vector<std::uint32_t> labels;
    };
    // Of labels in [0, end), at most so many lists; compact ones, as the file's class says.
    Lists lists(std::uint64_t end, std::uint64_t most);

    [[noreturn]] void fail(std::string_view what) const;

 private:
    enum class Form { Each, OneForAll, Nothing };  // "3(1 2 3)", "3{1}", "0"
    struct Opening {
        std::optional<std::uint64_t> count;  // texts need not say it
        Form form = Form::Each;
    };
    std::uint64_t leastBytesOfLabel() const { return header_.isBinary ? header_.labelBytes : 2; }
    Opening opening(std::uint64_t leastBytesOfEach, std::uint64_t most);
    void appendLabels(const Opening& list, std::int64_t least, std::uint64_t end,
                      std::uint64_t most, std::vector<std::uint32_t>& out);
    Lists compactLists(std::uint64_t end, std::uint64_t most);
    void readHeader();
    void readArch(std::string_view arch);
    static constexpr std::size_t kLongestWord = 4096;
    bool fill(std::size_t bytes);
    void skipBlanks();
    void skipLine();
    std::size_t wordEnd() const;
    // As next(), but it stays.
    std::string_view peek();
    void readBytes(std::uint64_t count, char* out);
    template <typename T>
    T number();
    // use(value) for each of so many numbers of this type.
    template <typename Stored, typename Use>
    void forEachBinary(std::uint64_t count, const Use& use);
    std::uint32_t label(std::int64_t value, std::int64_t least, std::uint64_t end) const;

    std::filesystem::path path_;
    std::uint64_t mostBytes_;  // that it can hold, unpacked
    std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
    FoamHeader header_;
    std::vector<char> buffer_;
    std::size_t at_ = 0, end_ = 0;          // in the buffer
    std::uint64_t passed_ = 0, lines_ = 0;  // before the buffer
    bool atEnd_ = false;
};

}  // namespace timeseries
