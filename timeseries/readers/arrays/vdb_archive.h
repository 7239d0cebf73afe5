// The grids of an OpenVDB file, from a stream that throws where the file ends. io::File's own does
// not: OpenVDB 10 then takes what stands in memory for what the file holds. Of vdb_file.cpp alone,
// for OpenVDB's templates are compiled there.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <fstream>
#include <map>

namespace timeseries {

class VdbArchive final : public openvdb::io::Archive {
 public:
    // Both throw std::ios_base::failure where the file ends early, and what OpenVDB throws.
    explicit VdbArchive(const std::filesystem::path& path) {
        stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
        stream_.open(path, std::ios::binary);
        readHeader(stream_);
        about_->setSeekable(true);
        openvdb::io::setStreamMetadataPtr(stream_, about_, /*transfer=*/false);
        setFormatVersion(stream_);
        setLibraryVersion(stream_);
        setDataCompression(stream_);
        openvdb::MetaMap().readMeta(stream_);
        for (std::int32_t left = readGridCount(stream_); left > 0; --left) {
            openvdb::io::GridDescriptor grid;
            grid.read(stream_);
            if (inputHasGridOffsets()) {
                checkEnd(grid.getEndPos());
                grid.seekToEnd(stream_);
            } else {  // one behind the other
                all_[grid.uniqueName()] = readNext(grid);
            }
            grids_.emplace(grid.uniqueName(), grid);
        }
    }
    // Of a name as io::File tells it.
    openvdb::GridBase::Ptr read(const std::string& name) {
        for (const auto& [unique, of] : grids_)
            if (openvdb::io::GridDescriptor::nameAsString(unique) == name)
                return readUnique(unique, 0);
        throw std::ios_base::failure("a grid that is gone");
    }
    openvdb::SharedPtr<openvdb::io::Archive> copy() const override { return {}; }  // not asked for

 private:
    void checkEnd(std::int64_t end) {
        const auto here = stream_.tellg();
        stream_.seekg(0, std::ios::end);
        if (end < here || end > stream_.tellg())
            throw std::ios_base::failure("a grid that ends elsewhere");
        stream_.seekg(here);
    }
    openvdb::GridBase::Ptr readNext(const openvdb::io::GridDescriptor& of) {
        const auto grid = openvdb::GridBase::createGrid(of.gridType());
        if (of.saveFloatAsHalf()) grid->setSaveFloatAsHalf(true);
        Archive::readGrid(grid, of, stream_);
        return grid;
    }
    openvdb::GridBase::Ptr readUnique(const std::string& name, int depth) {
        const auto found = grids_.find(name);
        if (found == grids_.end() || depth > 8)
            throw std::ios_base::failure("a grid that refers to another");
        const openvdb::io::GridDescriptor& of = found->second;
        openvdb::GridBase::Ptr grid;
        if (inputHasGridOffsets()) {
            of.seekToGrid(stream_);
            grid = readNext(of);
        } else {
            grid = all_.at(name);
        }
        if (of.isInstance())  // it has the voxels of another
            grid->setTree(readUnique(of.instanceParentName(), depth + 1)->baseTreePtr());
        return grid;
    }

    // To which the stream points.
    openvdb::io::StreamMetadata::Ptr about_{new openvdb::io::StreamMetadata};
    std::ifstream stream_;
    std::map<std::string, openvdb::io::GridDescriptor> grids_;  // by unique name
    std::map<std::string, openvdb::GridBase::Ptr> all_;         // of a file without offsets
};

}  // namespace timeseries
