# Writes the files of FILES, one after the other, into the C++ file OUTPUT as the text that FUNCTION, declared in
# HEADER, returns, so that the program needs no files of its own.
set(text "")
foreach(file IN LISTS FILES)
    file(READ ${file} part)
    string(APPEND text "${part}")
endforeach()
string(FIND "${text}" ")text\"" end)
if(NOT end EQUAL -1)
    message(FATAL_ERROR "${FILES} end their own quotation")
endif()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

std::string_view lamella::${FUNCTION}() { return R\"text(${text})text\"; }
")
