#include "timeseries/readers/amrex/amrex_text.h"

#include <fmt/format.h>

#include <cmath>

#include "timeseries/readers/reader.h"
#include "timeseries/readers/text/number_text.h"

namespace timeseries {
namespace {

constexpr std::size_t kMostLetters = 4096;
constexpr std::int64_t kMostIndex = std::int64_t{1} << 30;

bool isBlankOrEnd(int c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == EOF; }

}  // namespace

int AmrexText::peek() { return from_.sgetc(); }

void AmrexText::take() {
    if (from_.sbumpc() == '\n') ++line_;
    ++taken_;
}

void AmrexText::skipBlanks() {
    while (peek() != EOF && isBlankOrEnd(peek())) take();
}

void AmrexText::fail(std::string_view expected) const {
    throw FileError(hasLines_ ? fmt::format("{}: line {}: expected {}", place_, line_, expected)
                              : fmt::format("{}: expected {}", place_, expected));
}

std::string AmrexText::word(std::string_view what) {
    skipBlanks();
    std::string word;
    for (; !isBlankOrEnd(peek()); take()) {
        if (word.size() == kMostLetters) fail(fmt::format("{}, found a longer word", what));
        word += static_cast<char>(peek());
    }
    if (word.empty()) fail(fmt::format("{}, but the text ends", what));
    return word;
}

std::string AmrexText::restOfLine() {
    std::string line;
    for (; peek() != '\n' && peek() != EOF; take()) {
        if (line.size() == kMostLetters) fail("a shorter line");
        line += static_cast<char>(peek());
    }
    if (peek() != EOF) take();
    const auto first = line.find_first_not_of(" \t\r");
    return first == line.npos ? "" : line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
}

std::int64_t AmrexText::integer(std::string_view what, std::int64_t least, std::int64_t most) {
    skipBlanks();
    std::string digits;
    for (; digits.size() < 20 && (peek() == '-' || (peek() >= '0' && peek() <= '9')); take())
        digits += static_cast<char>(peek());
    const auto found = numberOfText<std::int64_t>(digits);
    if (!found || *found < least || *found > most)
        fail(fmt::format("{} from {} to {}, found {}", what, least, most,
                         digits.empty() ? "none" : digits));
    return *found;
}

double AmrexText::number(std::string_view what) {
    const std::string text = word(what);
    const auto found = numberOfText<double>(text);
    if (!found || !std::isfinite(*found))
        fail(fmt::format("{}, a number, found '{:.40}'", what, text));
    return *found;
}

bool AmrexText::isNext(char c) {
    skipBlanks();
    return peek() == c;
}

void AmrexText::expect(char c) {
    if (!isNext(c)) fail(fmt::format("the character '{}'", c));
    take();
}

std::array<std::int64_t, 3> AmrexText::indices(std::size_t dimensions) {
    std::array<std::int64_t, 3> found{};
    for (std::size_t a = 0; a < dimensions; ++a) {
        expect(a == 0 ? '(' : ',');
        found[a] = integer("an index", -kMostIndex, kMostIndex);
    }
    expect(')');
    return found;
}

IndexBox AmrexText::box(std::size_t dimensions) {
    expect('(');
    const IndexBox box{indices(dimensions), indices(dimensions)};
    const auto nodes = indices(dimensions);
    expect(')');
    if (box.isEmpty()) fail("a box that holds cells");
    if (nodes != std::array<std::int64_t, 3>{}) fail("a box of cells, found one of nodes or faces");
    return box;
}

}  // namespace timeseries
