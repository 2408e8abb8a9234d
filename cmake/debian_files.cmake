# Script that CPack runs before it packs. Debian wants other forms of some files than `cmake --install` gives: the manual
# page compressed, and a changelog of its own.
set(root ${CPACK_TEMPORARY_DIRECTORY}/usr/share)
execute_process(COMMAND gzip -9nf ${root}/man/man1/shadow-inspector.1 COMMAND_ERROR_IS_FATAL ANY)

# The first heading of the changelog: ## 1.0.0, 2026-01-31
file(STRINGS ${CPACK_SI_CHANGELOG} headings REGEX "^## ")
list(GET headings 0 heading)
if(NOT heading MATCHES "^## ([0-9.]+), ([0-9-]+)$")
  message(FATAL_ERROR "CHANGELOG.md: the first heading '${heading}' is no version with a date: ## 1.0.0, 2026-01-31")
endif()
set(version ${CMAKE_MATCH_1})
set(day ${CMAKE_MATCH_2})
if(NOT version STREQUAL CPACK_PACKAGE_VERSION)
  message(FATAL_ERROR "CHANGELOG.md begins with version ${version}, the project is ${CPACK_PACKAGE_VERSION}")
endif()
execute_process(COMMAND env LC_ALL=C date -u -R -d ${day} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
set(changelog ${root}/doc/shadow-inspector/changelog)
file(WRITE ${changelog} "shadow-inspector (${version}) unstable; urgency=medium

  * CHANGELOG.md lists what changed.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
execute_process(COMMAND gzip -9nf ${changelog} COMMAND_ERROR_IS_FATAL ANY)
# Folders and files are as Debian has them, whatever the umask was.
file(CHMOD_RECURSE ${CPACK_TEMPORARY_DIRECTORY}/usr
  FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ
  DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
file(CHMOD ${CPACK_TEMPORARY_DIRECTORY}/usr/bin/shadow-inspector
  PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
