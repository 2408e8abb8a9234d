# The editor's font travels inside the binary. Debian: fonts-inter; fonts-dejavu-core serves as well.
set(fonts /usr/share/fonts /usr/local/share/fonts)
find_file(SI_FONT_REGULAR NAMES Inter-Regular.otf DejaVuSans.ttf PATHS ${fonts}
  PATH_SUFFIXES opentype/inter truetype/inter truetype/dejavu TTF inter dejavu NO_DEFAULT_PATH)
find_file(SI_FONT_STRONG NAMES Inter-SemiBold.otf DejaVuSans-Bold.ttf PATHS ${fonts}
  PATH_SUFFIXES opentype/inter truetype/inter truetype/dejavu TTF inter dejavu NO_DEFAULT_PATH)
find_file(SI_FONT_MEDIUM NAMES Inter-Medium.otf DejaVuSans.ttf PATHS ${fonts}
  PATH_SUFFIXES opentype/inter truetype/inter truetype/dejavu TTF inter dejavu NO_DEFAULT_PATH)
mark_as_advanced(SI_FONT_REGULAR SI_FONT_MEDIUM SI_FONT_STRONG)
foreach(font REGULAR MEDIUM STRONG)
  if(NOT SI_FONT_${font})
    message(WARNING "No font for the editor (Debian: fonts-inter); it falls back to ImGui's bitmap font.")
    set(SI_FONT_${font} "")
  endif()
endforeach()
set(SI_FONT_CPP ${CMAKE_BINARY_DIR}/font_data.cpp)
add_custom_command(
  OUTPUT ${SI_FONT_CPP}
  COMMAND ${CMAKE_COMMAND} -DOUT=${SI_FONT_CPP} -DREGULAR=${SI_FONT_REGULAR} -DMEDIUM=${SI_FONT_MEDIUM}
          -DSTRONG=${SI_FONT_STRONG}
          -P ${CMAKE_SOURCE_DIR}/cmake/embed_font.cmake
  DEPENDS ${SI_FONT_REGULAR} ${SI_FONT_MEDIUM} ${SI_FONT_STRONG} ${CMAKE_SOURCE_DIR}/cmake/embed_font.cmake
  VERBATIM COMMENT "Embedding the editor's font")
target_sources(si_ui PRIVATE ${SI_FONT_CPP})
