# SPDX-License-Identifier: GPL-3.0-or-later
# The version stands in project() alone; the date of a release stands in CHANGELOG.md, whose first entry has to be of that
# version. Manual pages, metainfo, packages, the About page and --version take both from here.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
file(STRINGS ${PROJECT_SOURCE_DIR}/CHANGELOG.md headings REGEX "^## ")
list(GET headings 0 heading)
if(NOT heading MATCHES "^## ([0-9.]+) \\(([0-9]+-[0-9][0-9]-[0-9][0-9])\\)$")
  message(FATAL_ERROR "The first entry of CHANGELOG.md must read \"## VERSION (YYYY-MM-DD)\", not \"${heading}\".")
endif()
set(BATTEN_RELEASE_DATE ${CMAKE_MATCH_2})
if(NOT CMAKE_MATCH_1 STREQUAL PROJECT_VERSION)
  message(FATAL_ERROR "CHANGELOG.md begins with version ${CMAKE_MATCH_1}, project() says ${PROJECT_VERSION}.")
endif()
