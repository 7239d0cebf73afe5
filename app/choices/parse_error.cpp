#include "app/choices/parse_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace app {
namespace {

// The first that looks like an option behind what ends them; "" where there is none.
std::string behindTheEnd(std::span<const char* const> arguments) {
    const auto end = std::ranges::find(arguments, std::string_view("--"));
    const auto option = std::find_if(end, arguments.end(), [](std::string_view argument) {
        return argument.starts_with('-') && argument != "--";
    });
    return option == arguments.end() ? "" : *option;
}

std::string unexpectedText(const std::vector<std::string>& arguments) {
    const auto option = std::ranges::find_if(
        arguments, [](const std::string& argument) { return argument.starts_with('-'); });
    if (option != arguments.end()) return "there is no option " + *option;
    return fmt::format("'{}' is not expected", arguments.front());
}

// Of "--size: At Most 1 required but received 2" and "--size: 1 required TEXT missing".
std::string mismatchText(std::string_view what) {
    constexpr std::string_view kReceived = "At Most 1 required but received ";
    const std::string option(what.substr(0, what.find(": ")));
    const std::size_t received = what.find(kReceived);
    if (received != what.npos)
        return fmt::format("{} is given {} times, where one is expected", option,
                           what.substr(received + kReceived.size()));
    if (what.ends_with(" missing")) return option + " has no value";
    return std::string(what);
}

}  // namespace

std::string parseErrorText(const CLI::App& app, const CLI::ParseError& error,
                           std::span<const char* const> arguments) {
    // A mistyped option is why one that is required is not there.
    const std::vector<std::string> unexpected = app.remaining(true);
    const bool isMissing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr,
               isExtra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    if (isMissing || isExtra)
        if (const std::string option = behindTheEnd(arguments); !option.empty())
            return fmt::format("{} stands behind --, which ends the options", option);
    if ((isMissing || isExtra) && !unexpected.empty()) return unexpectedText(unexpected);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
        return mismatchText(error.what());
    return error.what();
}

}  // namespace app
