// A variable of the environment, of this process and of what it starts, for a time.
#pragma once

#include <stdlib.h>

#include <optional>
#include <string>

namespace tests {

// Set, or taken away, while this lives; then as it was.
class Variable {
 public:
    Variable(const char* name, const std::optional<std::string>& value) : name_(name) {
        if (const char* was = getenv(name)) before_ = was;
        set(value);
    }
    ~Variable() { set(before_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

 private:
    void set(const std::optional<std::string>& value) {
        if (value)
            setenv(name_, value->c_str(), 1);
        else
            unsetenv(name_);
    }
    const char* name_;
    std::optional<std::string> before_;
};

}  // namespace tests
