# Writes the FILES into the C++ file OUTPUT as the list that FUNCTION, declared in HEADER, returns, so that the program
# needs no files of its own.
set(rows "")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(FIND "${text}" ")file~\"" end)
    if(NOT end EQUAL -1)
        message(FATAL_ERROR "${file} ends its own quotation")
    endif()
    string(APPEND rows "    EmbeddedFile{\"${name}\", R\"file~(${text})file~\"sv},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

#include <array>

namespace lamella {

using namespace std::string_view_literals;  // which know their lengths

std::span<const EmbeddedFile> ${FUNCTION}() {
    static constexpr std::array table{
        EmbeddedFile{},
${rows}    };
    return std::span(table).subspan(1);
}

}  // namespace lamella
")
