// A disk whose power goes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/faults/system_calls.h"

namespace tests {

// What a disk holds after the power went: of each file what the process that wrote it has synced,
// for another may be on another machine, and of the rest some pages; of names that were not synced
// the first ones.
class Disk {
 public:
    explicit Disk(std::mt19937_64& random) : random_(random) {}

    void put(const std::string& path, std::string bytes) {
        files_.push_back({bytes, std::move(bytes), {}});
        names_[path] = files_.size() - 1;
        namesThen_.assign(1, names_);
    }
    void doIt(const Done& what) {
        switch (what.what) {
            case Done::Write: {
                put(what, of(what.path).now);
                of(what.path).unsynced.push_back(what);
                break;
            }
            case Done::Sync:
                std::erase_if(of(what.path).unsynced, [&](const Done& write) {
                    if (write.process == what.process) put(write, of(what.path).synced);
                    return write.process == what.process;
                });
                break;
            case Done::SyncFolder:
                namesThen_.assign(1, names_);
                break;
            case Done::Rename:
                names_[what.to] = names_.at(what.path);
                names_.erase(what.path);
                namesThen_.push_back(names_);
                break;
            case Done::Remove:
                names_.erase(what.path);
                namesThen_.push_back(names_);
        }
    }
    // By name.
    std::map<std::string, std::string> afterTheCrash() {
        std::map<std::string, std::string> left;
        for (const auto& [name, file] : namesThen_[random_() % namesThen_.size()])
            left[name] = some(files_[file]);
        return left;
    }

 private:
    struct File {
        std::string now, synced;
        std::vector<Done> unsynced;
    };
    using Names = std::map<std::string, std::size_t>;

    static void put(const Done& write, std::string& bytes) {
        bytes.resize(std::max<std::size_t>(bytes.size(), write.at + write.bytes.size()));
        bytes.replace(write.at, write.bytes.size(), write.bytes);
    }
    File& of(const std::string& path) {
        if (!names_.contains(path)) {
            files_.emplace_back();
            names_[path] = files_.size() - 1;
            namesThen_.push_back(names_);
        }
        return files_[names_[path]];
    }
    std::string some(const File& file) {
        constexpr std::size_t kPage = 4096;
        std::string bytes = file.synced;
        for (std::size_t at = 0; at < file.now.size(); at += kPage) {
            const std::string page = file.now.substr(at, kPage);
            if (random_() % 2 == 0 ||
                file.synced.compare(at < file.synced.size() ? at : 0, kPage, page) == 0)
                continue;
            bytes.resize(std::max(bytes.size(), at + page.size()));
            bytes.replace(at, page.size(), page);
        }
        return bytes;
    }

    std::mt19937_64& random_;
    std::vector<File> files_;
    Names names_;
    std::vector<Names> namesThen_{
        Names()};  // as they were since the folder was synced, the oldest first
};

}  // namespace tests
