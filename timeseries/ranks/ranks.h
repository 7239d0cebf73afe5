// The processes of an MPI program that work on one thing together.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "timeseries/grid/pages.h"

namespace timeseries {

// What one rank failed at, thrown by all of them; what() is that rank's sentence.
struct RanksError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Every member is collective: all ranks call it, in the same order.
class Ranks {
 public:
    // The communicator stays the caller's, and must outlive this. No message is of more bytes than
    // `most`, for MPI counts with ints.
    explicit Ranks(MPI_Comm comm, std::size_t most = std::size_t{1} << 30);

    unsigned rank() const { return rank_; }
    unsigned size() const { return size_; }
    bool isFirst() const { return rank_ == 0; }

    // How many of the ranks are on this one's machine.
    unsigned onThisMachine() const;
    // Each number becomes its sum over all ranks.
    void sum(std::span<std::uint64_t> numbers) const;
    std::uint64_t sum(std::uint64_t number) const {
        sum({&number, 1});
        return number;
    }
    // Its sum over the ranks before this one.
    std::uint64_t sumBefore(std::uint64_t number) const;
    // The first rank's.
    std::string fromFirst(const std::string& text) const { return from(0, text); }
    // What all have, in the order of ranks: less than 2 GiB.
    template <typename T>
    std::vector<T> gather(std::span<const T> mine) const;
    // Of any size. To each other rank r goes mine[ends[r - 1], ends[r]); what comes from the
    // others, in the order of ranks, and where each one's ends.
    template <typename T>
    PageVector<T> exchange(std::span<const T> mine, std::span<const std::uint64_t> ends,
                           std::vector<std::uint64_t>& cameTo) const;
    // Runs it everywhere; when it throws anywhere, throws RanksError everywhere. What it calls of
    // this class must throw everywhere, or nowhere.
    void agreed(const std::function<void()>& stage) const;

 private:
    std::string from(unsigned rank, std::string text) const;
    std::vector<std::byte> gatherBytes(std::span<const std::byte> mine) const;
    void swap(std::span<const std::byte> out, unsigned to, std::span<std::byte> in,
              unsigned from) const;
    std::vector<std::uint64_t> countsToMe(std::span<const std::uint64_t> ends) const;

    MPI_Comm comm_;
    std::size_t most_;
    unsigned rank_ = 0, size_ = 1;
};

template <typename T>
std::vector<T> Ranks::gather(std::span<const T> mine) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<std::byte> bytes = gatherBytes(std::as_bytes(mine));
    std::vector<T> all(bytes.size() / sizeof(T));
    std::ranges::copy(bytes, std::as_writable_bytes(std::span(all)).begin());
    return all;
}

template <typename T>
PageVector<T> Ranks::exchange(std::span<const T> mine, std::span<const std::uint64_t> ends,
                              std::vector<std::uint64_t>& cameTo) const {
    static_assert(std::is_trivially_copyable_v<T>);
    cameTo = countsToMe(ends);
    cameTo[rank_] = 0;
    for (std::size_t r = 1; r < cameTo.size(); ++r) cameTo[r] += cameTo[r - 1];
    PageVector<T> came;
    agreed([&] { came.resize(cameTo.back()); });
    const auto part = [](auto all, std::span<const std::uint64_t> to, unsigned r) {
        const std::uint64_t begin = r == 0 ? 0 : to[r - 1];
        return all.subspan(begin, to[r] - begin);
    };
    for (unsigned away = 1; away < size_; ++away) {
        const unsigned to = (rank_ + away) % size_, from = (rank_ + size_ - away) % size_;
        swap(std::as_bytes(part(mine, ends, to)), to,
             std::as_writable_bytes(part(std::span(came), cameTo, from)), from);
    }
    return came;
}

}  // namespace timeseries
