// The image library: OpenImageIO behind lamella's own interface, as a module that is loaded on demand.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "engine/io/image_file.h"

namespace lamella {
namespace {

class Reader : public ImageReader {
  public:
    explicit Reader(std::unique_ptr<OIIO::ImageInput> input,
                    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory = nullptr)
        : memory_(std::move(memory)), input_(std::move(input)) {}

    std::optional<ImagePage> next_page() override {
        if (!input_->seek_subimage(page_ + 1, 0)) {
            input_->geterror();
            return {};
        }
        ++page_;
        const OIIO::ImageSpec& spec = input_->spec();
        ImagePage page{spec.width, spec.height, spec.depth,          spec.nchannels,
                       spec.deep,  {},          spec.format.c_str(), spec.alpha_channel};
        if (spec.format == OIIO::TypeDesc::UINT8) {
            type_ = OIIO::TypeDesc::UINT8;
            page.samples = SampleType::u8;
        } else if (spec.format == OIIO::TypeDesc::UINT16) {
            type_ = OIIO::TypeDesc::UINT16;
            page.samples = SampleType::u16;
        } else {
            type_ = OIIO::TypeDesc::FLOAT;
            page.samples = SampleType::f32;
        }
        return page;
    }

    std::string read_channel(int channel, void* samples) override {
        return input_->read_image(page_, 0, channel, channel + 1, type_, samples) ? "" : input_->geterror();
    }

    std::string read_bytes(std::uint8_t* samples) override {
        const int channels = input_->spec().nchannels;
        return input_->read_image(page_, 0, 0, channels, OIIO::TypeDesc::UINT8, samples) ? ""
                                                                                         : input_->geterror();
    }

  private:
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::TypeDesc type_;
    int page_ = -1;
};

/// Returns the library's name for the format that a file's ending indicates.
std::string format_of(const std::string& name) {
    std::string ending = name.substr(std::min(name.rfind('.') + 1, name.size()));
    if (ending == "tif") return "tiff";
    return ending == "pgm" ? "pnm" : ending;
}

OIIO::ImageSpec spec_of(const ImageData& image) {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    if (!image.compression.empty()) spec.attribute("compression", image.compression);
    if (image.linear) spec.attribute("oiio:ColorSpace", "linear");
    if (image.pixel_x > 0 && image.pixel_y > 0) {
        constexpr double mm_per_cm = 10;
        spec.attribute("ResolutionUnit", "cm");
        spec.attribute("XResolution", static_cast<float>(mm_per_cm / image.pixel_x));
        spec.attribute("YResolution", static_cast<float>(mm_per_cm / image.pixel_y));
    }
    return spec;
}

std::string write_to(OIIO::ImageOutput* output, const std::string& name, const ImageData& image) {
    if (output == nullptr) return OIIO::geterror();
    const bool written = output->open(name, spec_of(image)) &&
                         output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) && output->close();
    return written ? "" : output->geterror();
}

class OpenImageIoLibrary : public ImageLibrary {
  public:
    std::unique_ptr<ImageReader> open(const std::string& path) const override {
        OIIO::ImageSpec config;
        config["oiio:UnassociatedAlpha"] = 1;  // unchanged numbers from the file
        auto input = OIIO::ImageInput::open(path, &config);
        if (!input) {
            OIIO::geterror();
            return nullptr;
        }
        return std::make_unique<Reader>(std::move(input));
    }

    std::unique_ptr<ImageReader> open_bytes(const std::string& name, std::string_view bytes,
                                            std::string& why) const override {
        // Opens by the format's name: with a file name, all other readers would be tried as well.
        auto input = OIIO::ImageInput::create(format_of(name));
        if (!input) {
            why = OIIO::geterror();
            return nullptr;
        }
        // The reader requires a pointer to mutable data, but does not change it.
        auto memory =
            std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<char*>(bytes.data()), bytes.size());
        OIIO::ImageSpec spec, config;
        config["oiio:UnassociatedAlpha"] = 1;  // unchanged numbers from the file
        if (!input->set_ioproxy(memory.get()) || !input->open(name, spec, config)) {
            why = input->geterror();
            return nullptr;
        }
        return std::make_unique<Reader>(std::move(input), std::move(memory));
    }

    std::string encode(const std::string& name, const ImageData& image,
                       std::vector<std::byte>& file) const override {
        std::vector<unsigned char> bytes;
        OIIO::Filesystem::IOVecOutput memory(bytes);
        const auto output = OIIO::ImageOutput::create(name, &memory);
        std::string why = write_to(output.get(), name, image);
        const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
        file.assign(first, first + bytes.size());
        return why;
    }

    bool knows(const std::string& path) const override {
        const bool known = OIIO::ImageOutput::create(path) != nullptr;
        if (!known) OIIO::geterror();
        return known;
    }

    std::string write(const std::string& path, const ImageData& image) const override {
        const auto output = OIIO::ImageOutput::create(path);
        return write_to(output.get(), path, image);
    }
};

}  // namespace
}  // namespace lamella

extern "C" const lamella::ImageLibrary* lamella_image_library() {
    static const lamella::OpenImageIoLibrary library;
    return &library;
}
