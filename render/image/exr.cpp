#include "render/image/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfMultiView.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfVersion.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <system_error>

#include "render/image/picture_file.h"
#include "timeseries/together.h"

namespace render {

namespace {

constexpr std::array kColorChannels = {"R", "G", "B", "A"};

class FileOutput : public Imf::OStream {
 public:
    FileOutput(std::FILE* stream, const std::string& name)
        : OStream(name.c_str()), stream_(stream) {}

    void write(const char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (std::fwrite(bytes, 1, size, stream_) != size) throwLastError();
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(std::ftell(stream_)); }
    void seekp(std::uint64_t position) override {
        if (std::fseek(stream_, static_cast<long>(position), SEEK_SET) != 0) throwLastError();
    }

 private:
    [[noreturn]] static void throwLastError() {
        throw std::runtime_error(std::generic_category().message(errno));
    }
    std::FILE* stream_;
};

class MemoryInput : public Imf::IStream {
 public:
    MemoryInput(std::span<const std::byte> bytes, const std::string& name)
        : IStream(name.c_str()), bytes_(bytes) {}

    bool read(char out[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (count < 0 || size > bytes_.size() - position_) {
            throw std::runtime_error("the file ends too early");
        }
        std::memcpy(out, bytes_.data() + position_, size);
        position_ += size;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override {
        if (position > bytes_.size()) throw std::runtime_error("the file ends too early");
        position_ = static_cast<std::size_t>(position);
    }

 private:
    std::span<const std::byte> bytes_;
    std::size_t position_ = 0;
};

// Where the values of one channel lie in memory, for either direction.
Imf::Slice slice(float* first, std::size_t stride, const Imath::Box2i& window, double fill) {
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    return Imf::Slice::Make(Imf::FLOAT, first, window, stride * sizeof(float),
                            stride * sizeof(float) * width, 1, 1, fill);
}

std::vector<std::string> namesOf(std::span<const ExrView> views) {
    std::vector<std::string> names;
    for (const auto& view : views) names.push_back(view.name);
    return names;
}

[[maybe_unused]] bool isWritable(std::span<const ExrView> views) {
    if (views.empty()) return false;
    const glm::ivec2 size = views.front().image.size;
    const std::size_t count = views.front().image.pixels.size();
    return size.x >= 1 && size.y >= 1 &&
           std::all_of(views.begin(), views.end(), [&](const ExrView& view) {
               const bool named = !view.name.empty() || views.size() == 1;
               return named && view.image.size == size &&
                      std::all_of(view.scalars.begin(), view.scalars.end(),
                                  [&](const auto& scalar) {
                                      return scalar.second.size() == count &&
                                             scalar.first.find('.') == std::string::npos;
                                  });
           });
}

// Every channel of every view, under its name in the file.
template <class Visit>
void forEachChannel(std::span<const ExrView> views, const Visit& visit) {
    const auto names = namesOf(views);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto nameInFile = [&](const std::string& channel) {
            return Imf::insertViewName(channel, names, static_cast<int>(i));
        };
        // Imf::Slice serves reading as well as writing, so it wants mutable floats.
        auto* const pixels = const_cast<glm::vec4*>(views[i].image.pixels.data());
        for (std::size_t c = 0; c < kColorChannels.size(); ++c) {
            visit(nameInFile(kColorChannels[c]), &(*pixels)[static_cast<int>(c)], std::size_t{4});
        }
        for (const auto& [name, values] : views[i].scalars) {
            visit(nameInFile(name), const_cast<float*>(values.data()), std::size_t{1});
        }
    }
}

Imf::Header headerFor(std::span<const ExrView> views, const Metadata& metadata) {
    const glm::ivec2 size = views.front().image.size;
    Imf::Header header(size.x, size.y);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709, D65
    if (!views.front().name.empty()) Imf::addMultiView(header, namesOf(views));
    for (const auto& [key, value] : metadata) {
        assert(isMetadataKey(key));
        header.insert(key, Imf::StringAttribute(value));
    }
    forEachChannel(views, [&](const std::string& name, float*, std::size_t) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    });
    return header;
}

std::uint32_t littleEndian32(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
    return value;
}

// The library believes sizes in attributes and allocates for them before it reads, so they are
// checked here: the header is a list of (name \0, type \0, int32 size, value), ended by an empty
// name (OpenEXR File Layout, "Header Attributes").
void checkHeaderLayout(std::span<const std::byte> bytes) {
    if (bytes.size() < 8 || !Imf::isImfMagic(reinterpret_cast<const char*>(bytes.data()))) {
        throw std::runtime_error("is not an OpenEXR file");
    }
    const auto version = static_cast<int>(littleEndian32(bytes.subspan(4)));
    if (Imf::isMultiPart(version) || Imf::isNonImage(version)) {
        throw std::runtime_error(
            "holds several parts or deep pixels, which this program does not read");
    }
    auto rest = bytes.subspan(8);
    const auto take = [&](std::size_t count) {
        if (count > rest.size()) throw std::runtime_error("its header ends too early");
        rest = rest.subspan(count);
    };
    const auto takeText = [&] {
        const auto end = std::find(rest.begin(), rest.end(), std::byte{0});
        const auto length = static_cast<std::size_t>(end - rest.begin());
        take(length + 1);
        return length;
    };
    while (takeText() > 0) {
        takeText();
        if (rest.size() < 4) throw std::runtime_error("its header ends too early");
        const std::uint32_t size = littleEndian32(rest);
        take(4);
        take(size);
    }
}

void checkWindow(const Imath::Box2i& window) {
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    const bool sane = width >= 1 && height >= 1 && width <= kMaxPixels && height <= kMaxPixels &&
                      width * height <= kMaxPixels;
    if (sane) return;
    throw std::runtime_error("declares " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels, which this program does not read");
}

// InputFile allocates by the data window as soon as it is constructed; look before it does.
void checkDeclaredSize(std::span<const std::byte> bytes, const std::string& name) {
    MemoryInput in(bytes, name);
    in.seekg(8);
    auto version = static_cast<int>(littleEndian32(bytes.subspan(4)));
    Imf::Header header;
    header.readFrom(in, version);
    header.sanityCheck(Imf::isTiled(version));
    checkWindow(header.dataWindow());
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
        if (i.channel().xSampling != 1 || i.channel().ySampling != 1) {
            throw std::runtime_error("has subsampled channels, which this program does not read");
        }
    }
}

bool isColor(const std::string& channel) {
    return std::find(kColorChannels.begin(), kColorChannels.end(), channel) != kColorChannels.end();
}

// An empty view of the right shape, with room for its scalar channels.
ExrView emptyView(const std::string& name, const std::vector<std::string>& names,
                  const Imf::ChannelList& channels, const Imath::Box2i& window) {
    const glm::ivec2 size(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    ExrView view{name, Image(size)};
    const auto own = names.empty() ? channels : Imf::channelsInView(name, channels, names);
    int colors = 0;
    for (auto i = own.begin(); i != own.end(); ++i) {
        const std::string bare = Imf::removeViewName(i.name(), name);
        if (isColor(bare)) {
            colors += bare != "A";
        } else {
            view.scalars[bare].resize(view.image.pixels.size());
        }
    }
    if (colors != 3) throw std::runtime_error("has a view without R, G and B channels");
    return view;
}

ExrPicture readAll(std::span<const std::byte> bytes, const std::string& name) {
    checkHeaderLayout(bytes);
    checkDeclaredSize(bytes, name);
    MemoryInput in(bytes, name);
    Imf::InputFile file(in);
    const Imf::Header& header = file.header();
    const auto window = header.dataWindow();
    const auto names = Imf::hasMultiView(header) ? Imf::multiView(header) : Imf::StringVector{};
    ExrPicture picture;
    for (const auto& view : names.empty() ? Imf::StringVector{""} : names) {
        picture.views.push_back(emptyView(view, names, header.channels(), window));
    }
    Imf::FrameBuffer channels;
    forEachChannel(picture.views, [&](const std::string& channel, float* first,
                                      std::size_t stride) {
        channels.insert(channel, slice(first, stride, window, 1));  // only a missing A is filled
    });
    file.setFrameBuffer(channels);
    file.readPixels(window.min.y, window.max.y);
    for (auto i = header.begin(); i != header.end(); ++i) {
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute())) {
            picture.metadata[i.name()] = text->value();
        }
    }
    return picture;
}

}  // namespace

void writeExr(const std::filesystem::path& path, std::span<const ExrView> views,
              const Metadata& metadata) {
    assert(isWritable(views));
    static std::once_flag once;  // what is compressed, is so by the library's own threads
    std::call_once(
        once, [] { Imf::setGlobalThreadCount(static_cast<int>(timeseries::sharingThreads())); });
    PartialFile out(path);
    try {
        const Imf::Header header = headerFor(views, metadata);
        FileOutput stream(out.stream(), path.string());
        Imf::OutputFile file(stream, header);
        Imf::FrameBuffer channels;
        forEachChannel(views, [&](const std::string& name, float* first, std::size_t stride) {
            channels.insert(name, slice(first, stride, header.dataWindow(), 0));
        });
        file.setFrameBuffer(channels);
        file.writePixels(views.front().image.size.y);
    } catch (const std::exception& error) {
        throw ImageError(path, std::string("cannot be written: ") + error.what());
    }
    out.commit();
}

ExrPicture readExr(const std::filesystem::path& path) {
    const auto bytes = readPictureFile(path);
    try {
        return readAll(bytes, path.string());
    } catch (const std::exception& error) {
        throw ImageError(path, error.what());
    }
}

}  // namespace render
