#include "tests/support/remote_devices.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

namespace tests {

static_assert(sizeof(RemoteDevices::Controller) == 120);
static_assert(sizeof(RemoteDevices::Head) == 128);
static_assert(sizeof(RemoteDevices::Packet) == 376);

RemoteDevices::RemoteDevices(int port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error(fmt::format("no remote devices at port {}", port));
    // The devices as they begin, and as they are.
    receive();
    receive();
    hand(0).active = hand(1).active = 1;
}

RemoteDevices::~RemoteDevices() { close(socket_); }

void RemoteDevices::receive() {
    auto* bytes = reinterpret_cast<char*>(&packet_);
    for (std::size_t got = 0; got < sizeof packet_;) {
        const ssize_t count = read(socket_, bytes + got, sizeof packet_ - got);
        if (count <= 0) throw std::runtime_error("the remote devices went away");
        got += static_cast<std::size_t>(count);
    }
}

void RemoteDevices::send() {
    if (write(socket_, &packet_, sizeof packet_) != ssize_t(sizeof packet_))
        throw std::runtime_error("the remote devices went away");
}

RemoteDevices::Place place(const glm::dvec3& position, const glm::dquat& turn) {
    const auto f = [](double number) { return static_cast<float>(number); };
    return {{f(turn.x), f(turn.y), f(turn.z), f(turn.w)},
            {f(position.x), f(position.y), f(position.z)}};
}

}  // namespace tests
