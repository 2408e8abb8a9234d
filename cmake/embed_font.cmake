# Writes OUT: a C++ array for each of the fonts REGULAR, MEDIUM and STRONG; empty where no file was found.
set(body "// Generated from the fonts found at configure time.\n#include \"ui/widgets/font_data.h\"\n\nnamespace si {\nnamespace {\n")
foreach(font REGULAR MEDIUM STRONG)
  if(${font})
    file(READ "${${font}}" bytes HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
    string(APPEND body "constexpr unsigned char k${font}[] = {${bytes}};\n")
  else()
    string(APPEND body "constexpr std::span<const unsigned char> k${font};\n")
  endif()
endforeach()
string(APPEND body "}  // namespace\n"
  "std::span<const unsigned char> regular_font() { return kREGULAR; }\n"
  "std::span<const unsigned char> medium_font() { return kMEDIUM; }\n"
  "std::span<const unsigned char> strong_font() { return kSTRONG; }\n}  // namespace si\n")
file(WRITE ${OUT} "${body}")
