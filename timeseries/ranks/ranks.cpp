#include "timeseries/ranks/ranks.h"

#include <algorithm>
#include <exception>
#include <numeric>

namespace timeseries {
Ranks::Ranks(MPI_Comm comm, std::size_t most) : comm_(comm), most_(most) {
    int rank = 0, size = 1;
    MPI_Comm_rank(comm_, &rank);
    MPI_Comm_size(comm_, &size);
    rank_ = static_cast<unsigned>(rank);
    size_ = static_cast<unsigned>(size);
}

unsigned Ranks::onThisMachine() const {
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int size = 1;
    MPI_Comm_size(machine, &size);
    MPI_Comm_free(&machine);
    return static_cast<unsigned>(size);
}

void Ranks::sum(std::span<std::uint64_t> numbers) const {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T,
                  MPI_SUM, comm_);
}

std::uint64_t Ranks::sumBefore(std::uint64_t number) const {
    std::uint64_t before = 0;
    MPI_Exscan(&number, &before, 1, MPI_UINT64_T, MPI_SUM, comm_);
    return rank_ == 0 ? 0 : before;  // which MPI leaves undefined
}

std::string Ranks::from(unsigned rank, std::string text) const {
    std::uint64_t length = text.size();
    const int root = static_cast<int>(rank);
    MPI_Bcast(&length, 1, MPI_UINT64_T, root, comm_);
    text.resize(length);
    MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, root, comm_);
    return text;
}

std::vector<std::byte> Ranks::gatherBytes(std::span<const std::byte> mine) const {
    std::vector<int> sizes(size_), places(size_);
    const int own = static_cast<int>(mine.size());
    MPI_Allgather(&own, 1, MPI_INT, sizes.data(), 1, MPI_INT, comm_);
    std::exclusive_scan(sizes.begin(), sizes.end(), places.begin(), 0);
    std::vector<std::byte> all(static_cast<std::size_t>(places.back() + sizes.back()));
    MPI_Allgatherv(mine.data(), own, MPI_BYTE, all.data(), sizes.data(), places.data(), MPI_BYTE,
                   comm_);
    return all;
}

std::vector<std::uint64_t> Ranks::countsToMe(std::span<const std::uint64_t> ends) const {
    std::vector<std::uint64_t> out(ends.begin(), ends.end()), in(size_);
    for (std::size_t r = out.size(); r-- > 1;) out[r] -= out[r - 1];
    MPI_Alltoall(out.data(), 1, MPI_UINT64_T, in.data(), 1, MPI_UINT64_T, comm_);
    return in;
}

void Ranks::swap(std::span<const std::byte> out, unsigned to, std::span<std::byte> in,
                 unsigned from) const {
    const auto messagesOf = [&](std::size_t bytes) { return (bytes + most_ - 1) / most_; };
    const std::size_t sends = messagesOf(out.size()), receives = messagesOf(in.size());
    for (std::size_t i = 0; i < std::max(sends, receives); ++i) {
        const auto message = [&](auto all, std::size_t messages) {
            return i < messages ? all.subspan(i * most_, std::min(all.size() - i * most_, most_))
                                : all.first(0);
        };
        const auto put = message(out, sends);
        const auto get = message(in, receives);
        MPI_Sendrecv(put.data(), static_cast<int>(put.size()), MPI_BYTE,
                     i < sends ? static_cast<int>(to) : MPI_PROC_NULL, 0, get.data(),
                     static_cast<int>(get.size()), MPI_BYTE,
                     i < receives ? static_cast<int>(from) : MPI_PROC_NULL, 0, comm_,
                     MPI_STATUS_IGNORE);
    }
}

void Ranks::agreed(const std::function<void()>& stage) const {
    std::string what;
    std::uint64_t failed = size_;
    try {
        stage();
    } catch (const std::exception& error) {
        what = error.what();
        failed = rank_;
    }
    std::uint64_t first = failed;
    MPI_Allreduce(&failed, &first, 1, MPI_UINT64_T, MPI_MIN, comm_);
    if (first < size_) throw RanksError(from(static_cast<unsigned>(first), what));
}

}  // namespace timeseries
