// PNG images are read here; for all else the image library is loaded on first use.
#include "engine/io/image_file.h"

#include <fstream>

#include "engine/base/error.h"
#include "engine/base/module_file.h"
#include "engine/base/whole_file.h"
#include "engine/io/png_reader.h"

namespace lamella {
namespace {

const ImageLibrary& load() {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): a loader knows no types
    const auto library = reinterpret_cast<ImageLibraryFunction>(module_function(
        "liblamella_images.so", image_library_symbol, ModuleScope::own, "images cannot be read or written",
        "it belongs to lamella and lies beside its libraries, or in a folder that "
        "LD_LIBRARY_PATH names"));
    return *library();
}

/// Loads the library once and never unloads it; threads that call concurrently wait for each other.
const ImageLibrary& library() {
    static const ImageLibrary& loaded = load();
    return loaded;
}

}  // namespace

std::unique_ptr<ImageReader> open_images(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes(png_signature.size(), '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file || bytes != png_signature) return library().open(path);
    std::string why;
    return open_kept_png(whole_file(path, "an image"), why);
}

std::unique_ptr<ImageReader> open_images(const std::string& name, std::string_view bytes, std::string& why) {
    if (name.ends_with(".png")) return open_png(bytes, why);
    return library().open_bytes(name, bytes, why);
}

std::vector<std::byte> encode_image(const std::string& name, const ImageData& image) {
    std::vector<std::byte> file;
    const std::string why = library().encode(name, image, file);
    if (!why.empty()) throw FaultError("the image " + name + " cannot be made: " + why);
    return file;
}

bool is_image_name(const std::string& path) { return library().knows(path); }

void write_image(const std::string& path, const ImageData& image) {
    const std::string why = library().write(path, image);
    if (!why.empty()) throw FaultError(path + ": cannot be written: " + why);
}

}  // namespace lamella
