// A program started by a test: its environment, its end, and what it said.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ui {

class Process {
 public:
    struct Start {
        std::string program;  // looked up in PATH where it has no '/'
        std::vector<std::string> arguments;
        std::filesystem::path folder;  // to run in; stderr goes to a file in it
        std::map<std::string, std::optional<std::string>> environment;  // absent: taken away
        int keptOpen = -1;                                              // a descriptor handed on
    };
    explicit Process(const Start& start);  // throws std::runtime_error
    ~Process();                            // kills what still runs
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t id() const { return child_; }
    void signal(int number) const;
    bool isRunning();
    // Waits for the end; 128 + N when signal N ended it. Throws when it does not end in time.
    int exitCode();
    std::string errors() const;  // what it wrote to stderr so far

 private:
    pid_t child_ = -1;
    std::optional<int> exitCode_;
    std::filesystem::path errorFile_;
};

// The processes that one has started and that run; the dead that nobody has taken in do not count.
std::vector<pid_t> childrenOf(pid_t parent);
bool isRunning(pid_t process);

}  // namespace ui
