// ServedFolder: the files that a server may read and write.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "recipe/recipe.h"

namespace lamella {

/// A folder beyond which a server reaches no file.
class ServedFolder {
  public:
    /// Throws InputError where there is no such folder.
    explicit ServedFolder(const std::filesystem::path& folder);

    const std::filesystem::path& path() const { return folder_; }

    /// Returns where a file of this name lies. Throws HttpError 400 for anything but a relative path that
    /// stays within, also through links.
    std::filesystem::path file(const std::string& name) const;

    /// Checks that the files which a recipe's text names lie within; the text may have mistakes otherwise.
    /// Throws HttpError 400 for one that does not, InputError where the text is no TOML.
    void check_recipe(std::string_view text) const;

    /// Writes a file that was sent. Its name is a plain one, of letters, digits and "-_. ", with one of the
    /// endings of meshes, pictures and tables; where another file has it, a number is added. Returns the name
    /// that it got. Throws HttpError 400 for other names, FaultError when it cannot be written.
    std::string keep(const std::string& name, std::string_view bytes) const;

  private:
    std::filesystem::path folder_;  // canonical
};

}  // namespace lamella
