#include "timeseries/readers/vtk/vtk_raw_cells.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/vtk/vtk_xml_cells.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

bool isRaw(const VtkPiece& piece) {
    const bool lists = piece.connectivity.rawAt && piece.offsets.rawAt && piece.types.rawAt;
    return piece.places.rawAt && (piece.cells == 0 || (lists && !piece.faces && !piece.faceTables));
}

class RawNumbers {
 public:
    explicit RawNumbers(const std::filesystem::path& path)
        : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
        if (file_ < 0) failVtk(path, "", "expected a file that can be read");
    }
    ~RawNumbers() { ::close(file_); }
    RawNumbers(const RawNumbers&) = delete;
    RawNumbers& operator=(const RawNumbers&) = delete;

    // use(i, number) for each, on several threads at once.
    template <typename Use>
    void forEach(const VtkNumbers& numbers, const Use& use) const;

 private:
    void read(std::uint64_t at, char* out, std::size_t bytes) const;

    const std::filesystem::path& path_;
    int file_;
};

template <typename Use>
void RawNumbers::forEach(const VtkNumbers& numbers, const Use& use) const {
    constexpr std::uint64_t kAtOnce = std::uint64_t{1} << 15;  // they fit a core's cache
    const std::uint64_t pieces = (numbers.count + kAtOnce - 1) / kAtOnce;
    withType(numbers.type, [&]<typename T>(T) {
        std::atomic<std::uint64_t> next = 0;
        sharing(threadsFor(pieces, 2), [&](unsigned) {
            std::vector<T> some(std::min(kAtOnce, numbers.count));
            for (std::uint64_t piece = next++; piece < pieces; piece = next++) {
                const std::uint64_t first = piece * kAtOnce,
                                    count = std::min(kAtOnce, numbers.count - first);
                read(*numbers.rawAt + first * sizeof(T), reinterpret_cast<char*>(some.data()),
                     count * sizeof(T));
                for (std::uint64_t i = 0; i < count; ++i) use(first + i, some[i]);
            }
        });
    });
}

void RawNumbers::read(std::uint64_t at, char* out, std::size_t bytes) const {
    while (bytes > 0) {
        const ssize_t got = ::pread(file_, out, bytes, static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) failVtk(path_, "Cells", std::strerror(errno));
        if (got == 0) failVtk(path_, "Cells", "expected values, but the file ends");
        out += got;
        at += static_cast<std::uint64_t>(got);
        bytes -= static_cast<std::size_t>(got);
    }
}

void addPiece(const RawNumbers& numbers, const VtkPiece& piece, UnstructuredGrid& grid) {
    const std::uint64_t points = grid.points.size(), corners = grid.corners.size(),
                        cells = grid.types.size();
    grid.points.resize(points + piece.points);
    static_assert(sizeof grid.points[0] == 3 * sizeof(double));
    auto* const coordinates = reinterpret_cast<double*>(grid.points.data() + points);
    numbers.forEach(piece.places,
                    [&](std::uint64_t i, auto at) { coordinates[i] = static_cast<double>(at); });
    if (piece.cells == 0) return;
    grid.types.resize(cells + piece.cells);
    grid.ends.resize(cells + piece.cells);
    grid.corners.resize(corners + piece.connectivity.count);
    numbers.forEach(piece.types, [&](std::uint64_t i, auto type) {
        grid.types[cells + i] = vtkShape(static_cast<std::int64_t>(type));
    });
    numbers.forEach(piece.offsets, [&](std::uint64_t i, auto end) {
        grid.ends[cells + i] = vtkEnd(static_cast<std::int64_t>(end), corners);
    });
    std::mutex flaws;
    numbers.forEach(piece.connectivity, [&](std::uint64_t i, auto number) {
        const auto point = static_cast<std::int64_t>(number);
        auto& corner = grid.corners[corners + i];
        corner = vtkCorner(point, piece.points, points);
        if (corner != kNoPoint) return;
        const std::lock_guard lock(flaws);
        grid.keepFirst({corners + i, point, piece.points});
    });
}

}  // namespace

std::optional<UnstructuredGrid> rawVtkCells(const VtkHeader& header) {
    const bool isList = header.kind == VtkKind::XmlUnstructured;
    if (!isList || !std::ranges::all_of(header.pieces, isRaw)) return std::nullopt;
    const RawNumbers numbers(header.path);
    UnstructuredGrid grid;
    for (const VtkPiece& piece : header.pieces) addPiece(numbers, piece, grid);
    return grid;
}

}  // namespace timeseries
