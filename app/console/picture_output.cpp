// A picture is written to a temporary name first. Its ending decides the format and therefore stays last.
#include "app/console/picture_output.h"

#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/io/image_file.h"
#include "printers/common/thumbnail.h"

namespace lamella {

namespace {

/// Pictures of the usual kind need no library of image formats, which takes longer to load than they to draw.
bool is_png(const std::string& path) { return path.ends_with(".png"); }

void write(const std::string& path, const Picture& picture) {
    if (!is_png(path)) {
        write_image(path, {picture.width, picture.height, 3, picture.rgb});
        return;
    }
    const std::string file = png_file(picture, 5);
    std::ofstream out(path, std::ios::binary);
    out.write(file.data(), static_cast<std::streamsize>(file.size()));
    out.close();
    if (!out) throw FaultError(path + ": cannot be written");
}

}  // namespace

void check_is_picture(const std::string& option, const std::string& path) {
    if (is_png(path) || is_image_name(path)) return;
    throw InputError(
        option + ": " + path +
        " does not end in a known image format; accepted: a file ending in .png, .jpg, .tif, ...");
}

void write_picture(const std::string& path, const Picture& picture) {
    const std::filesystem::path final_path(path);
    const std::filesystem::path unfinished =
        final_path.parent_path() / (final_path.stem().string() + ".part" + final_path.extension().string());
    try {
        write(unfinished.string(), picture);
    } catch (const FaultError&) {
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
        throw;
    }
    std::error_code error;
    std::filesystem::rename(unfinished, final_path, error);
    if (error) throw FaultError(path + ": the finished file cannot be renamed: " + error.message());
}

}  // namespace lamella
