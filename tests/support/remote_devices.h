// Head and controllers of Monado's remote driver, moved from here: Monado 25's r_remote_data over
// TCP, a packet of fixed size in the host's byte order (drivers/remote/r_interface.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tests {

class RemoteDevices {
 public:
    struct Place {
        std::array<float, 4> xyzw{0, 0, 0, 1};
        std::array<float, 3> position{};
    };
    struct Controller {
        Place place;
        std::array<float, 3> linearVelocity, angularVelocity;
        std::array<float, 5> fingerCurl;
        float trigger, squeeze, squeezeForce;
        std::array<float, 2> stick;
        float trackpadForce;
        std::array<float, 2> trackpad;
        // 1 or 0 each.
        std::uint8_t handTracked, active, systemClick, systemTouch, aClick, aTouch, bClick, bTouch,
            triggerClick, triggerTouch, stickClick, stickTouch, trackpadTouch;
        std::array<std::uint8_t, 3> padding;
    };
    struct EyeView {
        std::array<float, 4> fov;
        Place place;
        std::uint32_t padding;
    };
    struct Head {
        std::array<EyeView, 2> eyes;
        Place centre;
        std::uint8_t eachEye;
        std::array<std::uint8_t, 3> padding;
    };
    struct Packet {
        std::array<char, 8> header;
        Head head;
        Controller left, right;
    };

    // Takes over where the devices are. Throws std::runtime_error when nobody answers at the port.
    explicit RemoteDevices(int port);
    ~RemoteDevices();
    RemoteDevices(const RemoteDevices&) = delete;
    RemoteDevices& operator=(const RemoteDevices&) = delete;

    Head& head() { return packet_.head; }
    Controller& hand(int i) { return i == 0 ? packet_.left : packet_.right; }
    void send();

 private:
    void receive();

    int socket_ = -1;
    Packet packet_{};
};

RemoteDevices::Place place(const glm::dvec3& position, const glm::dquat& turn = {1, 0, 0, 0});

}  // namespace tests
