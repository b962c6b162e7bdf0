# SPDX-License-Identifier: GPL-3.0-or-later
# Run by CPack on the installed tree before it is packed: what Debian's policy asks of a package beside the program's own
# files, and one date for all files, so that two builds give the same package byte for byte.
set(tree ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
set(doc ${tree}/usr/share/doc/batten)

# The change log in Debian's form, made from CHANGELOG.md. What divides or groups the items of CMake's lists is put aside.
file(READ ${CPACK_BATTEN_SOURCE}/CHANGELOG.md text)
string(ASCII 1 semicolon)
string(ASCII 2 open)
string(ASCII 3 close)
string(ASCII 4 backslash)
string(REPLACE "\\" "${backslash}" text "${text}")
string(REPLACE ";" "${semicolon}" text "${text}")
string(REPLACE "[" "${open}" text "${text}")
string(REPLACE "]" "${close}" text "${text}")
string(REPLACE "\n" ";" lines "${text}")
set(log "")
set(item "")
set(end "")

# Adds the item that has been read to the log, in lines of no more than 78 characters.
function(add_item)
  if(item STREQUAL "")
    return()
  endif()
  set(line "  *")
  string(REGEX REPLACE " +" ";" words "${item}")
  foreach(word IN LISTS words)
    string(LENGTH "${line} ${word}" length)
    if(length GREATER 78)
      string(APPEND log "${line}\n")
      set(line "   ")
    endif()
    string(APPEND line " ${word}")
  endforeach()
  set(log "${log}${line}\n" PARENT_SCOPE)
  set(item "" PARENT_SCOPE)
endfunction()

foreach(line IN LISTS lines)
  if(line MATCHES "^## ([0-9.]+) \\(([0-9-]+)\\)$")
    set(version ${CMAKE_MATCH_1})
    set(day ${CMAKE_MATCH_2})
    add_item()
    execute_process(COMMAND date -R -u -d "${day}" OUTPUT_VARIABLE stamp OUTPUT_STRIP_TRAILING_WHITESPACE
      COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND log "${end}batten (${version}) unstable; urgency=medium\n\n")
    set(end "\n -- ${CPACK_BATTEN_CONTACT}  ${stamp}\n\n")
  elseif(line MATCHES "^- (.*)$")
    set(next "${CMAKE_MATCH_1}")
    add_item()
    set(item "${next}")
  elseif(line MATCHES "^ *([^ #].*)$" AND NOT item STREQUAL "")  # goes on, indented or not
    string(APPEND item " ${CMAKE_MATCH_1}")
  endif()
endforeach()
add_item()
string(REPLACE "${semicolon}" ";" log "${log}")
string(REPLACE "${open}" "[" log "${log}")
string(REPLACE "${close}" "]" log "${log}")
string(REPLACE "${backslash}" "\\" log "${log}")
file(WRITE ${doc}/changelog "${log}${end}")
execute_process(COMMAND gzip --force --no-name --best ${doc}/changelog COMMAND_ERROR_IS_FATAL ANY)

file(WRITE ${doc}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Batten

Files: *
Copyright: 2026 The Batten developers
License: GPL-3+

License: GPL-3+
 This program is free software: you can redistribute it and/or modify it under the terms of the GNU General Public
 License as published by the Free Software Foundation, either version 3 of the License, or (at your option) any later
 version.
 .
 This program comes without any warranty; without even the implied warranty of merchantability or fitness for a
 particular purpose. See the GNU General Public License for more details.
 .
 On Debian systems, the complete text of the GNU General Public License version 3 can be found in
 /usr/share/common-licenses/GPL-3.
")
execute_process(COMMAND chmod -R u=rwX,go=rX ${tree} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND find ${tree} -exec touch --no-dereference --date "${CPACK_BATTEN_DATE}T00:00:00Z" {} +
  COMMAND_ERROR_IS_FATAL ANY)
# The archives in the package take the date from here.
execute_process(COMMAND date -u -d "${CPACK_BATTEN_DATE}T00:00:00Z" +%s OUTPUT_VARIABLE seconds
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(ENV{SOURCE_DATE_EPOCH} ${seconds})
