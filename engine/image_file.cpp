// Finding and loading the image library.
#include "engine/image_file.h"

#include <dlfcn.h>

#include "engine/error.h"

namespace lamella {
namespace {

constexpr const char* module_name = "liblamella_images.so";

/// Looked for where the program's own run path says, then where it was installed to.
const ImageLibrary& load() {
    void* module = dlopen(module_name, RTLD_NOW | RTLD_LOCAL);
    std::string why = module != nullptr ? "" : dlerror();
    if (module == nullptr)
        module = dlopen(LAMELLA_MODULE_FOLDER "/liblamella_images.so", RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) {
        throw FaultError("images cannot be read or written: " + why +
                         "; it belongs to lamella and lies beside its libraries, or in a folder that "
                         "LD_LIBRARY_PATH names");
    }
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): dlsym knows no types
    const auto library = reinterpret_cast<ImageLibraryFunction>(dlsym(module, image_library_symbol));
    if (library == nullptr) throw FaultError(std::string(module_name) + " is not lamella's: " + dlerror());
    return *library();
}

/// Loaded once and never unloaded; threads that come first together wait for each other.
const ImageLibrary& library() {
    static const ImageLibrary& loaded = load();
    return loaded;
}

}  // namespace

std::unique_ptr<ImageReader> open_images(const std::string& path) { return library().open(path); }

std::unique_ptr<ImageReader> open_images(const std::string& name, std::string_view bytes, std::string& why) {
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
