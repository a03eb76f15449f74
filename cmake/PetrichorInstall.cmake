# `cmake --install build/release --prefix P`:
#   P/bin/petrichor                  the program, which finds its data at ../share/petrichor
#   P/lib/libpetrichor_*.a           one library a room, with lib/cmake/petrichor for find_package
#   P/include/petrichor/ROOM/*.h     the public headers, formulas and shader texts
#   P/include/petrichor/petrichor.{glsl,hlsl}  the formulas for the shaders of other engines
#   P/share/petrichor                scenarios and presets
include(CMakePackageConfigHelpers)

set(rooms base formulas weather texproc scene gpu demo film)
set(petrichor_package ${CMAKE_INSTALL_LIBDIR}/cmake/petrichor)
set(petrichor_headers ${CMAKE_INSTALL_INCLUDEDIR}/petrichor)

# petrichor_warnings is linked privately by static libraries, so the export must know its name.
install(TARGETS petrichor_options petrichor_warnings EXPORT petrichor)
target_include_directories(petrichor_options INTERFACE $<INSTALL_INTERFACE:${petrichor_headers}>)
foreach(room IN LISTS rooms)
    set_target_properties(petrichor_${room} PROPERTIES EXPORT_NAME ${room})
    install(TARGETS petrichor_${room} EXPORT petrichor ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(DIRECTORY ${room} DESTINATION ${petrichor_headers}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.glsl" PATTERN "*_lookup.inc" PATTERN "*_search.inc" PATTERN "air_radiance.inc" PATTERN "probes_from_*.inc" PATTERN "detail" EXCLUDE)
endforeach()
# One file a language, for engines that find no includes (docs/shaders.md).
set(shader_library ${PROJECT_BINARY_DIR}/shader_library)
add_custom_command(OUTPUT ${shader_library}/petrichor.glsl ${shader_library}/petrichor.hlsl
    COMMAND petrichor headers --language glsl hlsl -o ${shader_library}
    DEPENDS petrichor VERBATIM)
add_custom_target(petrichor_shader_library ALL
    DEPENDS ${shader_library}/petrichor.glsl ${shader_library}/petrichor.hlsl)
install(FILES ${shader_library}/petrichor.glsl ${shader_library}/petrichor.hlsl DESTINATION ${petrichor_headers})
install(TARGETS petrichor_film_weather EXPORT petrichor ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT petrichor NAMESPACE petrichor:: DESTINATION ${petrichor_package}
    FILE petrichorTargets.cmake)

configure_package_config_file(cmake/petrichorConfig.cmake.in
    ${PROJECT_BINARY_DIR}/petrichorConfig.cmake INSTALL_DESTINATION ${petrichor_package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/petrichorConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/petrichorConfig.cmake
    ${PROJECT_BINARY_DIR}/petrichorConfigVersion.cmake DESTINATION ${petrichor_package})

install(TARGETS petrichor RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/petrichor)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/petrichor)
