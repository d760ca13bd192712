# Writes the machine profiles of FOLDER into the C++ file OUTPUT, so that the program needs no files of its own.
file(GLOB files ${FOLDER}/*.toml)
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
    get_filename_component(name ${file} NAME_WLE)
    file(READ ${file} text)
    string(FIND "${text}" ")toml\"" end)
    if(NOT end EQUAL -1)
        message(FATAL_ERROR "${file} ends its own quotation")
    endif()
    string(APPEND rows "    ProfileText{\"${name}\", R\"toml(${text})toml\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// The machine profiles of printers/profiles.
#include \"printers/common/profile_texts.h\"

#include <array>

namespace lamella {

std::span<const ProfileText> profile_texts() {
    static constexpr auto table = std::to_array<ProfileText>({
${rows}    });
    return table;
}

}  // namespace lamella
")
