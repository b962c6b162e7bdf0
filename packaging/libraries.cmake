# SPDX-License-Identifier: GPL-3.0-or-later
# What the programs are linked with or made from, in one list: the About page, the SPDX file and the check of the package
# (packaging/try-package holds it against what the programs load) are made from it.
# The versions of those that say theirs to pkg-config or in a header alone; nothing where it is not found.
function(batten_pc_version name out)
  find_file(batten_pc_${name} ${name}.pc PATHS ${CMAKE_SYSTEM_PREFIX_PATH} NO_CACHE
    PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/pkgconfig lib/pkgconfig lib64/pkgconfig)
  set(version "")
  if(batten_pc_${name})
    file(STRINGS ${batten_pc_${name}} version REGEX "^Version: ")
    string(REGEX REPLACE "^Version: *" "" version "${version}")
  endif()
  set(${out} "${version}" PARENT_SCOPE)
endfunction()
batten_pc_version(libturbojpeg turbojpeg_version)
batten_pc_version(dxflib dxflib_version)
batten_pc_version(poppler-qt6 poppler_version)
find_file(batten_occt_header Standard_Version.hxx PATH_SUFFIXES opencascade NO_CACHE)
set(occt_version "")
if(batten_occt_header)
  file(STRINGS ${batten_occt_header} occt_version REGEX "^#define OCC_VERSION_COMPLETE ")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" occt_version "${occt_version}")
endif()

# NAME | version | licence (SPDX) | home | what it is for | the shared libraries' names, or - where only headers are used
set(BATTEN_LIBRARIES
  "Qt|${Qt6_VERSION}|LGPL-3.0-only|https://www.qt.io|window, pictures, files|libQt6"
  "QCustomPlot|2.1|GPL-3.0-or-later|https://www.qcustomplot.com|plots|libQCustomPlotQt6"
  "OpenCV|${OpenCV_VERSION}|Apache-2.0|https://opencv.org|reading scans|libopencv_"
  "libpng|${PNG_VERSION_STRING}|libpng-2.0|http://www.libpng.org|PNG|libpng"
  "libjpeg-turbo|${turbojpeg_version}|IJG AND BSD-3-Clause AND Zlib|https://libjpeg-turbo.org|JPEG|libturbojpeg"
  "dxflib|${dxflib_version}|GPL-2.0-or-later|https://www.ribbonsoft.com/en/what-is-dxflib|DXF|libdxflib"
  "Open CASCADE|${occt_version}|LGPL-2.1-only WITH OCCT-exception-1.0|https://dev.opencascade.org|IGES and STEP|libTK"
  "Poppler|${poppler_version}|GPL-2.0-only OR GPL-3.0-only|https://poppler.freedesktop.org|pages of PDF|libpoppler"
  "OpenSSL|${OPENSSL_VERSION}|Apache-2.0|https://www.openssl.org|SHA-256|libcrypto"
  "Eigen|${Eigen3_VERSION}|MPL-2.0|https://eigen.tuxfamily.org|linear algebra|-"
  "expected|${tl-expected_VERSION}|CC0-1.0|https://github.com/TartanLlama/expected|results that may fail|-"
  "JSON for Modern C++|${nlohmann_json_VERSION}|MIT|https://json.nlohmann.me|recipes and curves|-"
  "CLI11|${CLI11_VERSION}|BSD-3-Clause|https://github.com/CLIUtils/CLI11|command line|-"
  "GCC runtime|${CMAKE_CXX_COMPILER_VERSION}|GPL-3.0-or-later WITH GCC-exception-3.1|https://gcc.gnu.org|C++ library|libstdc++ libgcc_s"
  "C library||LGPL-2.1-or-later|https://www.gnu.org/software/libc|system|libc.so libm.so ld-linux")

set(BATTEN_LIBRARY_LINES "")  # for the About page
set(packages "")
set(relations "")
foreach(entry ${BATTEN_LIBRARIES})
  string(REPLACE "|" ";" fields "${entry}")
  list(GET fields 0 name)
  list(GET fields 1 version)
  list(GET fields 2 licence)
  list(GET fields 3 home)
  list(GET fields 4 use)
  list(GET fields 5 shared)
  string(REGEX REPLACE "[^A-Za-z0-9]+" "-" id "${name}")
  string(STRIP "${name} ${version}" shown)
  if(NOT name STREQUAL "C library")
    string(APPEND BATTEN_LIBRARY_LINES "- [${shown}](${home}): ${use}; ${licence}\n")
  endif()
  if(version STREQUAL "")
    set(version "NOASSERTION")
  endif()
  set(relation "DYNAMIC_LINK")
  if(shared STREQUAL "-")
    set(relation "CONTAINS")
  endif()
  string(APPEND packages "\nPackageName: ${name}\nSPDXID: SPDXRef-${id}\nPackageVersion: ${version}\n"
    "PackageDownloadLocation: ${home}\nFilesAnalyzed: false\nPackageLicenseConcluded: ${licence}\n"
    "PackageLicenseDeclared: ${licence}\nPackageCopyrightText: NOASSERTION\nPackageComment: <text>${use}; "
    "shared libraries: ${shared}</text>\n")
  string(APPEND relations "Relationship: SPDXRef-Batten ${relation} SPDXRef-${id}\n")
endforeach()
# The date is that of the release, not of the build: two builds are to be equal.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/packaging/batten.spdx @ONLY CONTENT [[SPDXVersion: SPDX-2.3
DataLicense: CC0-1.0
SPDXID: SPDXRef-DOCUMENT
DocumentName: Batten-@PROJECT_VERSION@
DocumentNamespace: @PROJECT_HOMEPAGE_URL@/spdx/batten-@PROJECT_VERSION@
Creator: Organization: The Batten developers
Created: @BATTEN_RELEASE_DATE@T00:00:00Z

PackageName: Batten
SPDXID: SPDXRef-Batten
PackageVersion: @PROJECT_VERSION@
PackageDownloadLocation: NOASSERTION
FilesAnalyzed: false
PackageLicenseConcluded: GPL-3.0-or-later
PackageLicenseDeclared: GPL-3.0-or-later
PackageCopyrightText: <text>The Batten developers</text>
@packages@
Relationship: SPDXRef-DOCUMENT DESCRIBES SPDXRef-Batten
@relations@]])
