#include "timeseries/readers/text/units.h"

#include <udunits2.h>

#include <memory>
#include <mutex>
#include <utility>

namespace timeseries {
namespace {

struct FreeUnit {
    void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
    void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

// One database for the process: reading it parses XML files. Null when they are not installed.
struct Database {
    std::mutex mutex;
    ut_system* system;
    Database() {
        ut_set_error_message_handler(ut_ignore);
        system = ut_read_xml(nullptr);
        // The names of times that files have of cftime and udunits has not.
        for (const auto& [name, unit] : {std::pair{"hrs", "hour"}, {"mins", "minute"}})
            if (const Unit known = parse(unit)) ut_map_name_to_unit(name, UT_ASCII, known.get());
    }
    ~Database() { ut_free_system(system); }
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    Unit parse(std::string text) {
        const auto first = text.find_first_not_of(" \t\r\n");
        const auto last = text.find_last_not_of(" \t\r\n");
        // udunits takes "" for the number one; a missing unit is not that.
        if (!system || first == std::string::npos) return nullptr;
        return Unit(ut_parse(system, text.substr(first, last - first + 1).c_str(), UT_UTF8));
    }
};

Database& database() {
    static Database one;
    return one;
}

}  // namespace

std::optional<double> unitRatio(const std::string& from, const std::string& to) {
    const std::lock_guard lock(database().mutex);
    const Unit a = database().parse(from), b = database().parse(to);
    if (!a || !b) return std::nullopt;
    const std::unique_ptr<cv_converter, FreeConverter> converter(
        ut_get_converter(a.get(), b.get()));
    if (!converter || cv_convert_double(converter.get(), 0.0) != 0.0) return std::nullopt;
    return cv_convert_double(converter.get(), 1.0);
}

bool sameDimension(const std::string& a, const std::string& b) {
    const std::lock_guard lock(database().mutex);
    const Unit first = database().parse(a), second = database().parse(b);
    return first && second && ut_are_convertible(first.get(), second.get()) != 0;
}

}  // namespace timeseries
