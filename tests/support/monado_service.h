// Monado's service for one test: its own folder, socket and port, ended with the object. This
// process (and its children) then know it as the active OpenXR runtime.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>

namespace tests {

enum class Monado {
    Null,    // a head that sways, two simple controllers; 320x240 pixels an eye, 20 Hz
    Window,  // the same devices; the real compositor, into a window of an Xvfb: 896x1007, 60 Hz
    Remote   // head and Index controllers as RemoteDevices has them; as Null otherwise
};

class MonadoService {
 public:
    // Returns when it answers. Throws std::runtime_error with its log when it does not.
    explicit MonadoService(Monado mode);
    ~MonadoService();
    MonadoService(const MonadoService&) = delete;
    MonadoService& operator=(const MonadoService&) = delete;

    void kill();                                    // at once; returns when it is gone
    void stop();                                    // SIGSTOP: it answers nothing and does not go
    int remotePort() const { return remotePort_; }  // REQUIRES: Remote
    std::string log() const;

 private:
    void start(Monado mode);
    void end();
    void startDisplay();
    void startRemote(const std::map<std::string, std::string>& environment);
    void configureRemote();
    void startService(const std::map<std::string, std::string>& environment);
    void endService();

    std::filesystem::path folder_;
    pid_t service_ = 0, display_ = 0;
    // Closed with this process, however it ends: the service reads it, and ends with it.
    int serviceInput_ = -1;
    int remotePort_ = 0;
};

}  // namespace tests
