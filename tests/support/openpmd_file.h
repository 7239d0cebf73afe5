// Small openPMD files: the attributes that the standard asks for around what a test puts.
#pragma once

#include <string>
#include <vector>

#include "tests/support/hdf_file.h"

namespace tests {

class OpenPmdFile : public HdfFile {
 public:
    explicit OpenPmdFile(const std::string& name = "file.h5") : HdfFile(name) {
        const auto root = [&](const std::string& attribute, const std::string& text) {
            say("", attribute, text);
        };
        root("openPMD", "1.1.0");
        root("basePath", "/data/%T/");
        root("meshesPath", "fields/");
        root("particlesPath", "particles/");
        root("iterationEncoding", "groupBased");
        root("iterationFormat", "/data/%T/");
    }
    void iteration(int number, double time, double unit = 1) {
        const std::string group = "data/" + std::to_string(number);
        say(group, "time", time);
        say(group, "dt", 1.0);
        say(group, "timeUnitSI", unit);
    }
    // A letter a label.
    void place(const std::string& record, const std::string& labels,
               const std::vector<double>& spacing, const std::vector<double>& offset) {
        std::vector<std::string> all;
        for (const char label : labels) all.emplace_back(1, label);
        say(record, "axisLabels", all);
        say(record, "geometry", std::string("cartesian"));
        say(record, "dataOrder", std::string("C"));
        say(record, "gridSpacing", spacing);
        say(record, "gridGlobalOffset", offset);
        say(record, "gridUnitSI", 1.0);
    }
    // Of 0, 1, 2, ...
    void mesh(const std::string& record, const std::vector<std::size_t>& lengths = {2, 2, 2}) {
        std::vector<double> values;
        for (std::size_t i = 0; i < lengths[0] * lengths[1] * lengths[2]; ++i)
            values.push_back(double(i));
        put(record, values, lengths);
        place(record, "zyx", {1, 1, 1}, {0, 0, 0});
    }
    template <typename T>
    void constant(const std::string& component, T value, const std::vector<std::uint64_t>& shape) {
        say(component, "value", std::vector<T>{value});
        say(component, "shape", shape);
    }
};

}  // namespace tests
