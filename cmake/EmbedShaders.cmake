# Writes OUT, a .cpp that defines shader_source() (client/render/gl/shader_sources.h) with the text of every file in DIR.
# Run as a script: cmake -DDIR=… -DOUT=… -P EmbedShaders.cmake
file(GLOB SHADERS ${DIR}/*.vert ${DIR}/*.geom ${DIR}/*.frag ${DIR}/*.glsl)
set(TEXT "#include \"client/render/gl/shader_sources.h\"\n\nnamespace scree {\n\n")
string(APPEND TEXT "std::string_view shader_source(std::string_view name) {\n")
foreach(SHADER ${SHADERS})
  get_filename_component(NAME ${SHADER} NAME)
  file(READ ${SHADER} SOURCE)
  string(REGEX REPLACE " *//[^\n]*" "" SOURCE "${SOURCE}") # a browser fetches them; lines keep their numbers
  string(APPEND TEXT "  if (name == \"${NAME}\") return R\"GLSL(${SOURCE})GLSL\";\n")
endforeach()
string(APPEND TEXT "  return {};\n}\n\n}  // namespace scree\n")
file(WRITE ${OUT} "${TEXT}")
