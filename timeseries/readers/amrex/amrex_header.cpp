#include "timeseries/readers/amrex/amrex_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <span>

#include "timeseries/readers/amrex/amrex_text.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostLevels = 100, kMostVariables = 1 << 16;
constexpr std::int64_t kMostFabs = std::int64_t{1} << 32;

std::ifstream openText(const fs::path& path) {
    expectFile(path);
    return std::ifstream(path, std::ios::binary);
}

// "HyperCLaw-V1.1", "NavierStokes-V1.1": a word, whatever program it is, and a version.
bool isVersion(const std::string& word) {
    const auto at = word.find("-V");
    return at != word.npos && at > 0 && at + 2 < word.size() && word[at + 2] >= '0' &&
           word[at + 2] <= '9' && word.find(' ') == word.npos;
}

// A relative path that stays below where it begins.
bool staysWithin(const fs::path& path) {
    return !path.empty() && path.is_relative() &&
           std::ranges::none_of(path, [](const fs::path& part) { return part == ".."; });
}

// What stands before the levels' own, and how many these are.
void readBeginning(AmrexText& text, AmrexPlotfile& file) {
    if (!isVersion(text.restOfLine())) text.fail("the name of a plotfile's version");
    const std::int64_t names = text.integer("a number of variables", 1, kMostVariables);
    text.restOfLine();
    std::set<std::string> seen;
    for (std::int64_t i = 0; i < names; ++i) {
        file.names.push_back(text.restOfLine());
        const std::string& name = file.names.back();
        if (name.empty()) text.fail("the name of a variable");
        if (!seen.insert(name).second)
            text.fail(fmt::format("names of variables that differ, found '{}' again", name));
    }
    file.dimensions = static_cast<std::size_t>(text.integer("a number of dimensions", 1, 3));
    if (file.dimensions == 1) text.fail("a plotfile of 2 or 3 dimensions, found one of 1");
    file.time = text.number("a time");
    file.lattice.resize(
        static_cast<std::size_t>(text.integer("a finest level", 0, kMostLevels - 1)) + 1);
}

// The sides of each level's cells.
std::vector<glm::dvec3> readDomain(AmrexText& text, AmrexPlotfile& file) {
    const int axes = static_cast<int>(file.dimensions);
    for (int a = 0; a < axes; ++a) file.lo[a] = text.number("an end of the domain");
    for (int a = 0; a < axes; ++a) file.hi[a] = text.number("an end of the domain");
    for (int a = 0; a < axes; ++a)
        if (!(file.lo[a] < file.hi[a]) || !std::isfinite(file.hi[a] - file.lo[a]))
            text.fail("a domain that takes space");
    // The domains tell by how much levels are finer, along each axis.
    while (!text.isNext('(')) text.integer("a ratio of refinement", 1, 1 << 20);
    for (LatticeLevel& level : file.lattice) level.domain = text.box(file.dimensions);
    for (std::size_t l = 0; l < file.lattice.size(); ++l) text.word("the step of a level");
    std::vector<glm::dvec3> sides(file.lattice.size(), glm::dvec3(0));
    for (glm::dvec3& side : sides)
        for (int a = 0; a < axes; ++a) side[a] = text.number("the side of a cell");
    static constexpr std::array kSystems{"", "of a cylinder (RZ)", "of a sphere"};
    const std::int64_t system = text.integer("a system of coordinates", 0, 2);
    if (system != 0)
        text.fail(fmt::format("Cartesian coordinates, found those {}, which are not read",
                              kSystems[static_cast<std::size_t>(system)]));
    text.integer("a width", -1, 1 << 20);
    return sides;
}

// They follow from the domain; written with six digits by some.
void checkCells(const AmrexText& text, const AmrexPlotfile& file,
                std::span<const glm::dvec3> sides) {
    for (std::size_t l = 0; l < sides.size(); ++l)
        for (std::size_t a = 0; a < file.dimensions; ++a) {
            const int c = static_cast<int>(a);
            const double side =
                (file.hi[c] - file.lo[c]) / static_cast<double>(file.lattice[l].domain.size()[a]);
            if (!(std::abs(sides[l][c] - side) <= 1e-3 * side))
                text.fail(
                    fmt::format("cells of level {} that fill the domain, found sides of {} "
                                "where {} do",
                                l, sides[l][c], side));
        }
}

// Files by their paths, each once.
using FileNumbers = std::map<fs::path, std::size_t>;

void readGhosts(AmrexText& text, std::size_t dimensions, AmrexLevel& level) {
    const auto one = [&] { return text.integer("a number of ghost cells", 0, 1 << 20); };
    if (!text.isNext('(')) {
        std::fill_n(level.ghosts.begin(), dimensions, one());
        return;
    }
    for (std::size_t a = 0; a < dimensions; ++a) {
        text.expect(a == 0 ? '(' : ',');
        level.ghosts[a] = one();
    }
    text.expect(')');
}

// A level's Cell_H, but for the least and greatest values at its end.
void readLevel(const fs::path& path, AmrexPlotfile& file, FileNumbers& numbers, std::size_t l) {
    std::ifstream stream = openText(path);
    AmrexText text(stream, path.string());
    LatticeLevel& lattice = file.lattice[l];
    AmrexLevel& level = file.levels[l];
    if (const auto version = text.integer("a version", 1, 1000); version != 1)
        text.fail(fmt::format("version 1, found {}, which is not read", version));
    text.integer("how it was written, a number", 0, 10);
    if (const auto count = text.integer("a number of variables", 0, kMostVariables);
        static_cast<std::size_t>(count) != file.names.size())
        text.fail(fmt::format("{} variables as in the Header, found {}", file.names.size(), count));
    readGhosts(text, file.dimensions, level);
    text.expect('(');
    const std::int64_t boxes = text.integer("a number of boxes", 1, kMostFabs);
    text.word("a number behind that of boxes");
    for (std::int64_t i = 0; i < boxes; ++i) lattice.boxes.push_back(text.box(file.dimensions));
    text.expect(')');
    if (text.integer("a number of FABs", 0, kMostFabs) != boxes)
        text.fail(fmt::format("as many FABs as there are boxes, {}", boxes));
    for (std::int64_t i = 0; i < boxes; ++i) {
        if (text.word("FabOnDisk:") != "FabOnDisk:") text.fail("the word FabOnDisk:");
        const fs::path name = text.word("the name of a file");
        if (!staysWithin(name) || name.has_parent_path())
            text.fail(fmt::format("the name of a file beside it, found '{}'", name.string()));
        const auto offset = text.integer("where a FAB begins", 0, std::int64_t{1} << 60);
        const auto [known, isNew] =
            numbers.try_emplace(path.parent_path() / name, file.files.size());
        if (isNew) file.files.push_back(known->first);
        level.fabs.push_back({known->second, static_cast<std::uint64_t>(offset)});
    }
}

void readLevels(AmrexText& text, AmrexPlotfile& file) {
    FileNumbers numbers;
    file.levels.resize(file.lattice.size());
    for (std::size_t l = 0; l < file.levels.size(); ++l) {
        const auto number = static_cast<std::int64_t>(l);
        text.integer("the number of the level", number, number);
        const std::int64_t boxes = text.integer("a number of boxes", 1, kMostFabs);
        text.number("a time");
        text.word("a step");
        for (std::size_t i = 0; i < static_cast<std::size_t>(boxes) * 2 * file.dimensions; ++i)
            text.word("an end of a box");
        const fs::path prefix = text.word("where the level's values are");
        if (!staysWithin(prefix))
            text.fail(fmt::format("a path within the folder, found '{}'", prefix.string()));
        file.texts.push_back(file.folder / (prefix.string() + "_H"));
        readLevel(file.texts.back(), file, numbers, l);
        if (file.levels[l].fabs.size() != static_cast<std::size_t>(boxes))
            text.fail(fmt::format("{} boxes of level {} as in {}", file.levels[l].fabs.size(), l,
                                  file.texts.back().string()));
    }
}

// Values take 4 bytes each at least.
void checkFiles(const AmrexPlotfile& file) {
    std::uint64_t cells = 0, bytes = 0;
    for (const fs::path& path : file.files) {
        expectFile(path);
        std::error_code ignored;
        const std::uint64_t size = fs::file_size(path, ignored);
        if (!ignored) bytes += size;
    }
    for (const LatticeLevel& level : file.lattice)
        for (const IndexBox& box : level.boxes) cells = std::min(cells + box.count(), kMaxPoints);
    if (cells > bytes / 4 / file.names.size())
        throw FileError(
            fmt::format("{}: expected values of {} variables in {} cells, found {} "
                        "bytes in the files of its levels",
                        file.folder.string(), file.names.size(), cells, bytes));
    if (cells >= kMaxPoints)
        throw FileError(fmt::format("{}: expected fewer than 2^32 cells", file.folder.string()));
    if (const std::string flaw = flawOf(file.lattice); !flaw.empty())
        throw FileError(
            fmt::format("{}: expected boxes of cells that fill the domain once, found "
                        "that {}",
                        file.folder.string(), flaw));
}

// Folders that are no level, and what stands beside the cells of the first one.
std::vector<std::string> othersIn(const AmrexPlotfile& file) {
    std::vector<std::string> others;
    const auto forEachIn = [](const fs::path& folder, const auto& use) {
        std::error_code error;
        for (fs::directory_iterator at(folder, error), end; !error && at != end;
             at.increment(error))
            use(*at);
    };
    const auto isLevel = [&](const fs::path& path) {
        return std::ranges::any_of(
            file.texts, [&](const fs::path& text) { return text.parent_path() == path; });
    };
    forEachIn(file.folder, [&](const fs::directory_entry& entry) {
        std::error_code ignored;
        if (entry.is_directory(ignored) && !isLevel(entry.path()))
            others.push_back(entry.path().filename().string());
    });
    const fs::path first = file.texts[1].parent_path();
    if (first != file.folder)
        forEachIn(first, [&](const fs::directory_entry& entry) {
            const std::string name = entry.path().filename().string();
            if (name.ends_with("_H") && entry.path() != file.texts[1])
                others.push_back((first.filename() / name.substr(0, name.size() - 2)).string());
        });
    std::ranges::sort(others);
    return others;
}

}  // namespace

bool isAmrex(const fs::path& path) {
    std::error_code ignored;
    const bool isFolder = fs::is_directory(path, ignored);
    const fs::path header = isFolder ? path / "Header" : path;
    if (header.filename() != "Header" || !fs::is_regular_file(header, ignored)) return false;
    std::ifstream file(header, std::ios::binary);
    std::string start(64, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    const auto end = start.find_first_of("\r\n");
    return end != start.npos && isVersion(start.substr(0, end));
}

fs::path amrexFolderOf(const fs::path& path) {
    std::error_code ignored;
    const fs::path folder = fs::is_directory(path, ignored) ? path : path.parent_path();
    if (folder.empty()) return ".";
    return folder.has_filename() || !folder.has_relative_path() ? folder : folder.parent_path();
}

std::size_t amrexLevelsOf(const fs::path& path) {
    const fs::path header = amrexFolderOf(path) / "Header";
    std::ifstream stream = openText(header);
    AmrexText text(stream, header.string());
    AmrexPlotfile file;
    readBeginning(text, file);
    return file.lattice.size();
}

AmrexPlotfile readAmrexHeader(const fs::path& path) {
    AmrexPlotfile file;
    file.folder = amrexFolderOf(path);
    file.texts.push_back(file.folder / "Header");
    std::ifstream stream = openText(file.texts[0]);
    AmrexText text(stream, file.texts[0].string());
    readBeginning(text, file);
    checkCells(text, file, readDomain(text, file));
    readLevels(text, file);
    checkFiles(file);
    file.others = othersIn(file);
    return file;
}

}  // namespace timeseries
