// Exceptions as a user is told of them.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <system_error>

namespace timeseries {

// What it says itself, which is a sentence where it is one of ours; another for those of the
// standard library that say what nobody would understand.
inline std::string sentenceOf(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return "there is not enough memory for this";
    const auto* const system = dynamic_cast<const std::system_error*>(&error);
    // As std::thread throws it.
    if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again)
        return "no thread can be made: the system allows no more threads or processes";
    return error.what();
}

}  // namespace timeseries
