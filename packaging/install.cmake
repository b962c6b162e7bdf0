# SPDX-License-Identifier: GPL-3.0-or-later
# What goes where when the programs are installed: cmake --install build/release --prefix ... The window finds its sample
# beside itself, as ../share/batten/samples; help, icons and theme are inside the program.
include(GNUInstallDirs)
set(id org.batten.Batten)
set(pages ${CMAKE_BINARY_DIR}/packaging)
set(doc ${CMAKE_INSTALL_DATADIR}/doc/batten)

install(TARGETS batten-cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
get_property(modules GLOBAL PROPERTY BATTEN_MODULE_TARGETS)
if(WIN32)
  install(TARGETS ${modules} LIBRARY DESTINATION ${CMAKE_INSTALL_BINDIR})
else()
  install(TARGETS ${modules} LIBRARY DESTINATION lib/batten/modules)
endif()
if(BATTEN_GUI)
  install(TARGETS batten RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} BUNDLE DESTINATION .)
endif()
install(FILES ${CMAKE_BINARY_DIR}/share/batten/samples/coupe-side.png
  ${CMAKE_BINARY_DIR}/share/batten/samples/coupe-side.recipe.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/batten/samples)
install(DIRECTORY resources/batch/ DESTINATION ${CMAKE_INSTALL_DATADIR}/batten/batch USE_SOURCE_PERMISSIONS)
install(DIRECTORY resources/help/ DESTINATION ${doc}/help FILES_MATCHING PATTERN "*.md"
  PATTERN about.md EXCLUDE)
if(BATTEN_GUI)
  install(FILES ${CMAKE_BINARY_DIR}/resources/help/about.md DESTINATION ${doc}/help)
endif()
install(FILES README.md ${pages}/batten.spdx DESTINATION ${doc})

if(WIN32 OR APPLE)
  # The libraries of Qt go along with the window program, and what it finds beside itself into its bundle; batten-cli needs
  # Qt and OpenCV where the system finds them. Not tried by us: we have neither system.
  if(BATTEN_GUI)
    if(APPLE)
      install(TARGETS ${modules} LIBRARY DESTINATION batten.app/Contents/lib/batten/modules)
      install(FILES ${CMAKE_BINARY_DIR}/share/batten/samples/coupe-side.png
        ${CMAKE_BINARY_DIR}/share/batten/samples/coupe-side.recipe.json
        DESTINATION batten.app/Contents/share/batten/samples)
    endif()
    qt_generate_deploy_app_script(TARGET batten OUTPUT_SCRIPT deploy_script NO_UNSUPPORTED_PLATFORM_ERROR)
    install(SCRIPT ${deploy_script})
  endif()
  return()
endif()

# Pages made from what the program says of itself.
set(options ${pages}/options.json)
set(parameters ${pages}/parameters.json)
file(MAKE_DIRECTORY ${pages})
add_custom_command(OUTPUT ${options} ${parameters}
  COMMAND batten-cli options > ${options}
  COMMAND batten-cli parameters --json > ${parameters}
  DEPENDS batten-cli COMMENT "Asking the program for its options" VERBATIM)
set(made "")
find_program(GZIP gzip)
function(batten_write_page what template output destination)
  set(template ${PROJECT_SOURCE_DIR}/packaging/man/${template})
  set(script ${PROJECT_SOURCE_DIR}/packaging/write_pages.cmake)
  set(made_file ${pages}/${what}/${output})
  set(compress ${CMAKE_COMMAND} -E true)
  set(result ${made_file})
  if(what STREQUAL "manual" AND GZIP)
    set(compress ${GZIP} --force --no-name --best --keep ${made_file})
    set(result ${made_file}.gz)
  endif()
  add_custom_command(OUTPUT ${result}
    COMMAND ${CMAKE_COMMAND} -DWHAT=${what} -DOPTIONS=${options} -DPARAMETERS=${parameters} -DTEMPLATE=${template}
      -DOUTPUT=${made_file} -DVERSION=${PROJECT_VERSION} -DDATE=${BATTEN_RELEASE_DATE} -P ${script}
    COMMAND ${compress}
    DEPENDS ${options} ${parameters} ${template} ${script} COMMENT "Writing ${output}" VERBATIM)
  install(FILES ${result} DESTINATION ${destination})
  set(made ${made} ${result} PARENT_SCOPE)
endfunction()
batten_write_page(manual batten-cli.1.in batten-cli.1 ${CMAKE_INSTALL_MANDIR}/man1)
if(BATTEN_GUI)
  batten_write_page(manual batten.1.in batten.1 ${CMAKE_INSTALL_MANDIR}/man1)
endif()
batten_write_page(bash batten-cli.bash.in batten-cli ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
batten_write_page(zsh batten-cli.zsh.in _batten-cli ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
add_custom_target(pages ALL DEPENDS ${made})

if(BATTEN_GUI)
  set(desktop packaging/desktop)
  configure_file(${desktop}/${id}.metainfo.xml.in ${pages}/${id}.metainfo.xml @ONLY)
  install(FILES ${desktop}/${id}.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES ${pages}/${id}.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
  install(FILES ${desktop}/${id}.mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME ${id}.xml)
  set(icons ${CMAKE_INSTALL_DATADIR}/icons/hicolor)
  install(FILES resources/icons/batten.svg DESTINATION ${icons}/scalable/apps RENAME ${id}.svg)
  install(FILES ${desktop}/icons/${id}-symbolic.svg DESTINATION ${icons}/symbolic/apps)
  install(FILES ${desktop}/icons/${id}-recipe.svg ${desktop}/icons/${id}-curves.svg
    DESTINATION ${icons}/scalable/mimetypes)
endif()
