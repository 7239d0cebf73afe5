// The lists of numbers in an OpenFOAM file.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/foam/foam_file.h"
#include "timeseries/readers/text/number_text.h"

namespace timeseries {
namespace {

constexpr std::uint64_t kFoamChunk = std::uint64_t{1} << 16;  // numbers that are read at once

}  // namespace

// In text, from where the file stands.
template <typename T>
T FoamFile::number() {
    skipBlanks();
    fill(kLongestWord);
    const char* const begin = buffer_.data() + at_;
    const char* const last = buffer_.data() + wordEnd();
    T value{};
    const auto [stop, error] = std::from_chars(begin, last, value);
    if (error != std::errc() || stop != last) {
        const std::string word(begin, last);
        const auto other = numberOfText<T>(word);
        if (word.starts_with('$') || word.starts_with('#'))
            fail(fmt::format("expected numbers, found {}: macros are not read", word));
        if (!other) fail(fmt::format("expected a number, found '{}'", std::string(next())));
        value = *other;
    }
    at_ = static_cast<std::size_t>(last - buffer_.data());
    return value;
}

void FoamFile::readBytes(std::uint64_t count, char* out) {
    while (count > 0) {
        if (!fill(1)) fail(fmt::format("expected {} bytes more, but the file ends", count));
        const std::uint64_t part = std::min<std::uint64_t>(count, end_ - at_);
        std::memcpy(out, buffer_.data() + at_, part);
        out += part;
        at_ += part;
        count -= part;
    }
}

template <typename Stored, typename Use>
void FoamFile::forEachBinary(std::uint64_t count, const Use& use) {
    std::vector<Stored> chunk(std::min(count, kFoamChunk));
    for (std::uint64_t left = count; left > 0;) {
        const std::uint64_t part = std::min<std::uint64_t>(left, chunk.size());
        readBytes(part * sizeof(Stored), reinterpret_cast<char*>(chunk.data()));
        for (std::uint64_t i = 0; i < part; ++i) use(chunk[i]);
        left -= part;
    }
}

FoamFile::Opening FoamFile::opening(std::uint64_t leastBytesOfEach, std::uint64_t most) {
    if (!header_.isBinary && take("(")) return {};
    const auto count = number<std::uint64_t>();
    if (count > most) fail(fmt::format("expected a list of at most {}, found {}", most, count));
    if (!header_.isBinary && take("{")) return {count, Form::OneForAll};
    if (count == 0) return {count, take("(") ? Form::Each : Form::Nothing};
    if (count > mostBytes_ / leastBytesOfEach)
        fail(fmt::format("expected a list that the file can hold, found one of {}", count));
    expect("(");
    return {count, Form::Each};
}

std::uint32_t FoamFile::label(std::int64_t value, std::int64_t least, std::uint64_t end) const {
    if (value < least || value >= static_cast<std::int64_t>(end))
        fail(fmt::format("expected numbers from {} to below {}, found {}", least, end, value));
    return static_cast<std::uint32_t>(value);
}

void FoamFile::appendLabels(const Opening& list, std::int64_t least, std::uint64_t end,
                            std::uint64_t most, std::vector<std::uint32_t>& out) {
    const auto add = [&](std::int64_t value) { out.push_back(label(value, least, end)); };
    if (list.form == Form::Nothing) return;
    if (list.form == Form::OneForAll) {
        out.resize(out.size() + *list.count, label(number<std::int64_t>(), least, end));
        expect("}");
        return;
    }
    if (!list.count) {
        for (std::uint64_t count = 0; !take(")"); ++count) {
            if (count == most) fail(fmt::format("expected a list of at most {}", most));
            add(number<std::int64_t>());
        }
        return;
    }
    if (!header_.isBinary)
        for (std::uint64_t i = 0; i < *list.count; ++i) add(number<std::int64_t>());
    else if (header_.labelBytes == 8)
        forEachBinary<std::int64_t>(*list.count, add);
    else
        forEachBinary<std::int32_t>(*list.count, add);
    expect(")");
}

std::vector<std::uint32_t> FoamFile::labels(std::int64_t least, std::uint64_t end,
                                            std::uint64_t most) {
    std::vector<std::uint32_t> all;
    appendLabels(opening(leastBytesOfLabel(), most), least, end, most, all);
    return all;
}

// The place of each list's first in the list of all, and that behind the last; then this list.
FoamFile::Lists FoamFile::compactLists(std::uint64_t end, std::uint64_t most) {
    const auto begins = labels(0, kNoPoint, most + 1);
    Lists lists{{}, labels(0, end, kNoPoint)};
    if (begins.empty()) return lists;
    for (std::size_t i = 1; i < begins.size(); ++i) {
        if (begins[i] < begins[i - 1])
            fail(fmt::format("expected lists one behind the other, found one from {} to {}",
                             begins[i - 1], begins[i]));
        lists.ends.push_back(begins[i]);
    }
    if (begins.front() != 0 || begins.back() != lists.labels.size())
        fail(fmt::format("expected lists from 0 to {}, found {} to {}", lists.labels.size(),
                         begins.front(), begins.back()));
    return lists;
}

FoamFile::Lists FoamFile::lists(std::uint64_t end, std::uint64_t most) {
    if (header_.isBinary && header_.className == "faceCompactList") return compactLists(end, most);
    constexpr std::uint64_t kMostOfOne = 1 << 20;
    Lists lists;
    const auto add = [&] {
        const Opening one = opening(leastBytesOfLabel(), kMostOfOne);
        if (one.form == Form::OneForAll) fail("expected a list of labels that differ");
        appendLabels(one, 0, end, kMostOfOne, lists.labels);
        lists.ends.push_back(lists.labels.size());
    };
    const Opening list = opening(2, most);
    if (list.form == Form::OneForAll) fail("expected lists that differ, found one for all");
    if (list.form == Form::Nothing) return lists;
    if (!list.count) {
        while (!take(")")) {
            if (lists.ends.size() == most) fail(fmt::format("expected at most {} lists", most));
            add();
        }
        return lists;
    }
    for (std::uint64_t i = 0; i < *list.count; ++i) add();
    expect(")");
    return lists;
}

template <std::floating_point T>
void FoamFile::row(std::uint64_t components, T* out) {
    if (components > 1) expect("(");
    for (std::uint64_t c = 0; c < components; ++c) out[c] = number<T>();
    if (components > 1) expect(")");
}

template <std::floating_point T>
std::vector<T> FoamFile::rows(std::uint64_t components, std::uint64_t least, std::uint64_t most) {
    std::vector<T> all;
    const auto check = [&](std::uint64_t count) {
        if (count < least) fail(fmt::format("expected a list of {}, found {}", least, count));
    };
    const auto add = [&] {
        all.resize(all.size() + components);
        row(components, all.data() + all.size() - components);
    };
    const Opening list = opening(components * (header_.isBinary ? header_.scalarBytes : 2), most);
    if (list.count) check(*list.count);
    if (list.form == Form::Nothing) return all;
    if (list.form == Form::OneForAll) {
        // Nothing else would bound what it takes.
        if (least != most) fail("expected a list of rows that differ, found one for all");
        add();
        const std::vector<T> one = all;
        all.reserve(*list.count * components);
        while (all.size() < *list.count * components) all.insert(all.end(), one.begin(), one.end());
        expect("}");
        all.resize(*list.count * components);
        return all;
    }
    if (!list.count) {
        while (!take(")")) {
            if (all.size() == most * components)
                fail(fmt::format("expected a list of at most {}", most));
            add();
        }
        check(all.size() / components);
        return all;
    }
    const std::uint64_t count = *list.count * components;
    if (least == most) all.reserve(count);  // the mesh bounds it, not this file alone
    const auto keep = [&](auto value) { all.push_back(static_cast<T>(value)); };
    if (!header_.isBinary)
        while (all.size() < count) add();
    else if (header_.scalarBytes == 8)
        forEachBinary<double>(count, keep);
    else
        forEachBinary<float>(count, keep);
    expect(")");
    return all;
}

template void FoamFile::row(std::uint64_t, float*);
template void FoamFile::row(std::uint64_t, double*);
template std::vector<float> FoamFile::rows(std::uint64_t, std::uint64_t, std::uint64_t);
template std::vector<double> FoamFile::rows(std::uint64_t, std::uint64_t, std::uint64_t);

}  // namespace timeseries
