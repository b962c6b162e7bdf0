# SPDX-License-Identifier: GPL-3.0-or-later
# Packages by CPack: `cpack` in the build folder. On Debian a .deb that names exactly the packages whose libraries the
# programs load, on Windows and macOS archives with the libraries of the window program (not tried by us: we have neither).
set(CPACK_PACKAGE_NAME batten)
set(CPACK_PACKAGE_VENDOR "The Batten developers")
set(BATTEN_MAINTAINER "The Batten developers <maintainers@batten.invalid>" CACHE STRING "Who answers for a package")
set(CPACK_PACKAGE_CONTACT "${BATTEN_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "turn scanned sketches into fair curves")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_VERBATIM_VARIABLES ON)

if(WIN32)
  set(CPACK_GENERATOR ZIP)
elseif(APPLE)
  set(CPACK_GENERATOR DragNDrop)
else()
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_SET_DESTDIR OFF)
  # Every folder and file is root's and readable, whatever the umask of who builds.
  set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  # Loaded when the window runs, so dpkg-shlibdeps cannot see them: the window system's plugin, and icons in SVG.
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "qt6-qpa-plugins, libqt6svg6")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-inter")
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "parallel, slurm-client, snakemake")
  set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Batten follows the lines of a scanned or photographed drawing and turns
them into fair curves: lines, arcs, polynomials and quintic B-splines whose
curvature changes the way a designer wants. It finds pencil lines on shaded,
folded and dirty paper, and shows curvature while a curve is made fair. It
writes SVG and PDF in millimetres, exact curves as DXF, IGES, STEP, 3DM and
JSON, points and polynomials as CSV, and reports in PDF and HTML.

The package holds the window program batten and the command line program
batten-cli, which also runs over an archive of drawings.")
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/finish_tree.cmake)
  set(CPACK_BATTEN_DATE ${BATTEN_RELEASE_DATE})
  set(CPACK_BATTEN_SOURCE ${PROJECT_SOURCE_DIR})
  set(CPACK_BATTEN_CONTACT "${BATTEN_MAINTAINER}")
endif()
include(CPack)
