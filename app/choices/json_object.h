// A JSON object that a user may have written by hand, read strictly.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "app/choices/choice_text.h"

namespace app {

// JSON of which no object has a key twice: of two values that differ one would be lost. Throws
// ChoiceError, and what the parser throws.
nlohmann::json parseStrictly(auto&& input) {
    using nlohmann::json;
    std::vector<std::set<std::string>> keys;  // of the objects that are open, outermost first
    return json::parse(input, [&](int, json::parse_event_t event, const json& parsed) {
        if (event == json::parse_event_t::object_start) keys.emplace_back();
        if (event == json::parse_event_t::object_end) keys.pop_back();
        if (event == json::parse_event_t::key &&
            !keys.back().insert(parsed.get_ref<const std::string&>()).second)
            throw ChoiceError(fmt::format("an object has the key '{}' twice",
                                          parsed.get_ref<const std::string&>()));
        return true;
    });
}

// One JSON object being read: every key must be asked for, and be of the type asked for.
class JsonObject {
 public:
    JsonObject(const nlohmann::json& object, std::string where)
        : object_(object), where_(std::move(where)) {
        if (!object.is_object()) throw ChoiceError(fmt::format("{} is not a JSON object", where_));
    }
    // Calls use(value) when the key is there.
    template <typename T, typename Use>
    void read(const char* key, const Use& use) {
        known_.insert(key);
        const auto found = object_.find(key);
        if (found == object_.end()) return;
        if (!is<T>(*found))
            throw ChoiceError(fmt::format("{}.{} is not {}", where_, key, expected<T>()));
        try {
            // No copy of what is read further on: copies of deep nesting overflow the stack.
            if constexpr (std::is_same_v<T, nlohmann::json>)
                use(*found);
            else
                use(found->get<T>());
        } catch (const std::invalid_argument& error) {
            throw ChoiceError(fmt::format("{}.{}: {}", where_, key, error.what()));
        }
    }
    std::string place(const char* key) const { return fmt::format("{}.{}", where_, key); }
    void refuseOthers() const {
        for (const auto& [key, value] : object_.items())
            if (!known_.contains(key))
                throw ChoiceError(fmt::format("{} has an unknown key '{}'", where_, key));
    }

 private:
    // As JSON has one kind of number, 1.0 is one too; beyond these no double is a certain one.
    static bool isWhole(const nlohmann::json& value) {
        constexpr double kMostCertain = 1ll << 53;
        if (!value.is_number_float())
            return value.is_number_integer() &&
                   (!value.is_number_unsigned() ||
                    value.get<std::uint64_t>() <= std::numeric_limits<std::int64_t>::max());
        const auto number = value.get<double>();
        return std::trunc(number) == number && std::abs(number) < kMostCertain;
    }
    // Stricter than nlohmann's conversions, which take true for 1 and 2.7 for 2.
    template <typename T>
    static bool is(const nlohmann::json& value) {
        if constexpr (std::is_same_v<T, std::string>) return value.is_string();
        if constexpr (std::is_same_v<T, bool>) return value.is_boolean();
        if constexpr (std::is_same_v<T, double>) return value.is_number();
        if constexpr (std::is_same_v<T, std::int64_t>) return isWhole(value);
        if constexpr (std::is_same_v<T, std::vector<std::string>>)
            return value.is_array() && std::ranges::all_of(value, is<std::string>);
        if constexpr (std::is_same_v<T, std::vector<double>>)
            return value.is_array() && std::ranges::all_of(value, is<double>);
        return true;
    }
    template <typename T>
    static const char* expected() {
        if constexpr (std::is_same_v<T, std::string>) return "a text";
        if constexpr (std::is_same_v<T, bool>) return "true or false";
        if constexpr (std::is_same_v<T, std::int64_t>) return "a whole number";
        if constexpr (std::is_same_v<T, double>) return "a number";
        if constexpr (std::is_same_v<T, std::vector<double>>) return "a list of numbers";
        return "a list of texts";
    }
    const nlohmann::json& object_;
    std::string where_;
    std::set<std::string> known_;
};

}  // namespace app
