#include "timeseries/readers/vtk/vtk_glance.h"

#include <fmt/format.h>

#include <mutex>
#include <new>
#include <utility>

#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/vtk/vtk_file.h"
#include "timeseries/readers/vtk/vtk_parts.h"
#include "timeseries/readers/vtk/vtk_time.h"
#include "timeseries/readers/vtk/vtk_variables.h"

namespace timeseries {
namespace {

struct Seen {
    std::optional<VtkTime> time;
    std::vector<VtkArray> arrays;
};

// Of files that are read whole, one at a time: their cells may take much memory.
std::unique_lock<std::mutex> alone() {
    static std::mutex mutex;
    return std::unique_lock(mutex);
}

void seeAll(const std::filesystem::path& path, Seen& seen) {
    const auto lock = alone();
    VtkContents contents = vtkContentsOf(path);
    seen = {contents.whole.time, std::move(contents.whole.arrays)};
}

// The arrays are those of the first part that holds points, the time is the file's own, or the
// first that a part tells.
void seeParts(const XmlFile& file, Seen& seen) {
    bool isFirst = true, byVtkAlone = false;
    forEachVtkPart(file, [&](const XmlFile& part) {
        if (isEmptyVtkFile(part)) return true;
        if (std::exchange(isFirst, false)) seen.arrays = readVtkXmlHeader(part).arrays;
        const VtkTold told = vtkTimeOf(part);
        byVtkAlone = told.byVtkAlone;
        seen.time = told.time;
        return !byVtkAlone && !seen.time;
    });
    if (byVtkAlone) return seeAll(file.path, seen);
    keepDeclared(file, seen.arrays);
    if (const VtkTold own = vtkTimeOf(file); own.time) seen.time = own.time;
}

void seeXml(const XmlSoFar& read, Seen& seen) {
    const XmlFile& file = read.file;
    const std::string_view type = file.root.attribute("type");
    const bool isAlone = !vtkTypeOfParts(fmt::format("P{}", type)).empty();
    if (!read.flaw.empty()) {
        if (isAlone) seen.time = vtkTimeOf(file).time;  // it may stand before the flaw
        throw FileError(read.flaw);
    }
    if (!vtkTypeOfParts(type).empty()) return seeParts(file, seen);
    const VtkTold told = isAlone ? vtkTimeOf(file) : VtkTold{{}, true};
    if (told.byVtkAlone) return seeAll(file.path, seen);
    seen.time = told.time;
    seen.arrays = readVtkXmlHeader(file).arrays;
}

}  // namespace

std::optional<Glance> vtkGlanceAt(const std::filesystem::path& path) {
    Glance glance;
    Seen seen;
    try {
        expectFile(path);
        if (isVtkSeries(path)) return std::nullopt;
        if (isVtkLegacy(path)) {
            const auto lock = alone();
            VtkHeader header = readVtkLegacyHeader(path);
            seen = {header.time, std::move(header.arrays)};
        } else {
            const XmlSoFar read = readXmlSoFar(path);
            if (read.file.root.attribute("type") == "Collection") return std::nullopt;
            seeXml(read, seen);
        }
        for (VtkVariable& each : vtkVariablesOf(path, seen.arrays))
            glance.variables.push_back(std::move(each.name));
    } catch (const FileError& flaw) {
        glance.flaw = flaw.what();
    } catch (const std::filesystem::filesystem_error& gone) {  // while it was looked at
        glance.flaw = fmt::format("{}: cannot be read: {}", path.string(), gone.code().message());
    } catch (const std::bad_alloc&) {
        glance.flaw = fmt::format("{}: there is not enough memory to read it", path.string());
    }
    glance.time = std::make_shared<const TimeAxis>(vtkTimeAxisOf(seen.time));
    return glance;
}

}  // namespace timeseries
