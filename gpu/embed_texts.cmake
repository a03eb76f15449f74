# cmake -DROOT=... -DOUTPUT=... -DFILES="a;b" -P embed_texts.cmake: shader texts as a C++ table.
set(rows "")
foreach(file IN LISTS FILES)
    file(READ ${ROOT}/${file} text)
    string(APPEND rows "        {\"${file}\", R\"petrichor_text(${text})petrichor_text\", \"\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"gpu/compiler/compiler.h\"

namespace petrichor::gpu {

std::span<const ShaderText> embedded_texts()
{
    static const std::vector<ShaderText> texts{
${rows}    };
    return texts;
}

}  // namespace petrichor::gpu
")
