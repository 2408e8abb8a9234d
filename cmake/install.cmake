# Installation, and the Debian package that CPack makes of it. The program embeds all files that it reads itself. Files
# in share/shadow-inspector are for people: writers of bundles, and presets to begin with.
install(TARGETS shadow-inspector RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY assets/bundle assets/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/shadow-inspector/assets)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md packaging/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Pages of docs/ link to ../assets.
file(RELATIVE_PATH SI_ASSETS_FROM_DOCS ${CMAKE_INSTALL_FULL_DOCDIR} ${CMAKE_INSTALL_FULL_DATADIR}/shadow-inspector/assets)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/installed)
file(CREATE_LINK ${SI_ASSETS_FROM_DOCS} ${CMAKE_BINARY_DIR}/installed/assets SYMBOLIC)
install(FILES ${CMAKE_BINARY_DIR}/installed/assets DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Manual page and completions come from the commands of the program that is installed.
function(si_install_printed words name folder)
  string(REPLACE ";" " " words "${words}")
  install(CODE "
    execute_process(COMMAND \"$<TARGET_FILE:shadow-inspector>\" ${words}
      OUTPUT_FILE \"${CMAKE_BINARY_DIR}/installed/${name}\" COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${CMAKE_BINARY_DIR}/installed/${name} DESTINATION ${folder} ${ARGN})
endfunction()
si_install_printed(man-page shadow-inspector.1 ${CMAKE_INSTALL_MANDIR}/man1)
si_install_printed("completion;bash" shadow-inspector.bash ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME shadow-inspector)
si_install_printed("completion;zsh" _shadow-inspector ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
si_install_printed("completion;fish" shadow-inspector.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

install(FILES packaging/shadow-inspector.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES packaging/shadow-inspector.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES packaging/shadow-inspector-mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
  RENAME shadow-inspector.xml)
install(FILES packaging/icons/shadow-inspector.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)

# The package: cpack --config build/release/CPackConfig.cmake
set(SI_MAINTAINER "Shadow Inspector authors <shadow-inspector@invalid.invalid>" CACHE STRING
  "Name and address of who answers for the Debian package")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME shadow-inspector)
set(CPACK_PACKAGE_CONTACT "${SI_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/package)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# epoxy opens these by name, and so does what it opens.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libgl1, libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "xclip")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-renderdoc, python3-numpy")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "inspector of shadow maps, interactive and headless")
set(CPACK_PACKAGE_DESCRIPTION
  "Shows a scene beside its live shadow map, explains why a pixel is lit or in
shadow, and measures what accuracy costs.
Opens models, frames of other engines and RenderDoc captures.")
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/debian_files.cmake)
set(CPACK_SI_CHANGELOG ${CMAKE_SOURCE_DIR}/CHANGELOG.md)
include(CPack)
