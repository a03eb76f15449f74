# petrichor_add_shaders(TARGET NAME.STAGE.glsl ...)
#
# Compiles GLSL to SPIR-V at build time, prepares it (gpu/device/prepared.h) and embeds both: every shader becomes a
# header with two arrays, and one table maps names ("lighting.comp") to them. Editing an included header recompiles
# its users.
function(petrichor_add_shaders target)
    set(output_dir ${CMAKE_CURRENT_BINARY_DIR}/shaders)
    file(MAKE_DIRECTORY ${output_dir})
    set(table_includes "")
    set(table_rows "")
    set(headers "")
    foreach(source IN LISTS ARGN)
        get_filename_component(file ${source} NAME)
        string(REGEX REPLACE "\\.glsl$" "" name ${file})
        string(REPLACE "." "_" symbol ${name})
        string(REGEX REPLACE ".*\\." "" stage ${name})
        set(header ${output_dir}/${name}.h)
        set(binary ${output_dir}/${name}.spv)
        add_custom_command(
            OUTPUT ${binary}
            COMMAND Vulkan::glslangValidator -V --quiet --target-env vulkan1.3 -S ${stage}
                    -I${PROJECT_SOURCE_DIR} $<IF:$<CONFIG:Debug>,-gVS,-g0>
                    --depfile ${binary}.d -o ${binary}
                    ${CMAKE_CURRENT_SOURCE_DIR}/${source}
            DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source}
            DEPFILE ${binary}.d
            COMMENT "Compiling shader ${name}"
            VERBATIM)
        add_custom_command(
            OUTPUT ${header}
            COMMAND petrichor-embed-shader ${symbol} ${binary} ${header}
            DEPENDS ${binary} petrichor-embed-shader
            COMMENT "Preparing shader ${name}"
            VERBATIM)
        list(APPEND headers ${header})
        string(APPEND table_includes "#include \"${header}\"\n")
        string(APPEND table_rows "    {\"${name}\", ${symbol}, ${symbol}_prepared},\n")
    endforeach()
    file(GENERATE OUTPUT ${output_dir}/embedded_shaders.cpp CONTENT
"#include \"gpu/device/shaders.h\"

namespace petrichor::gpu {
namespace {
${table_includes}}  // namespace

std::span<const EmbeddedShader> embedded_shaders()
{
    static const EmbeddedShader all[] = {
${table_rows}    };
    return all;
}

}  // namespace petrichor::gpu
")
    target_sources(${target} PRIVATE ${output_dir}/embedded_shaders.cpp ${headers})
endfunction()
