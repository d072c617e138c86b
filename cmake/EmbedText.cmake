# Writes OUT, a .cpp that defines scree::FUNCTION(), which HEADER declares, with the text of FILE.
# Run as a script: cmake -DFILE=… -DOUT=… -DHEADER=… -DFUNCTION=… -P EmbedText.cmake
file(READ ${FILE} SOURCE)
set(TEXT "#include \"${HEADER}\"\n\nnamespace scree {\n\n")
string(APPEND TEXT "std::string_view ${FUNCTION}() {\n  return R\"TEXT(${SOURCE})TEXT\";\n}\n\n}  // namespace scree\n")
file(WRITE ${OUT} "${TEXT}")
