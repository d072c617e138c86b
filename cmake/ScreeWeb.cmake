# The build of the client in a browser (preset web), by Debian's emscripten: its flags, and the libraries of which Debian
# has binaries for this machine alone, compiled from Debian's sources, which `./scree web` unpacks into build/web/sources.
enable_language(C)

# Where Debian has acorn, by which emscripten reads the JavaScript that it links.
set(CMAKE_CXX_LINKER_LAUNCHER env NODE_PATH=/usr/share/nodejs)

# Vectors of 128 bits. No source of ours knows that libc++ is older here; kernels give the same bits as everywhere
# (tests/web). Threads there are none: drawing's jobs run between frames (client/render/scene/work_pool.h).
target_compile_options(scree_usage INTERFACE -msimd128 SHELL:-include${PROJECT_SOURCE_DIR}/client/web/stand_ins/ranges.h)

# Libraries that are headers only are this machine's; of GLFW, the numbers of keys. A folder of links, because /usr/include has another C library's
# headers, too.
set(SCREE_WEB_INCLUDE ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${SCREE_WEB_INCLUDE})
foreach(HEADER glm tl nlohmann xxhash.h GLFW)
  if(NOT EXISTS /usr/include/${HEADER})
    message(FATAL_ERROR "/usr/include/${HEADER} is missing: ./scree setup installs it")
  endif()
  file(CREATE_LINK /usr/include/${HEADER} ${SCREE_WEB_INCLUDE}/${HEADER} SYMBOLIC)
endforeach()
target_include_directories(scree_usage SYSTEM INTERFACE ${SCREE_WEB_INCLUDE} ${PROJECT_SOURCE_DIR}/client/web/stand_ins)

# fmt, in a tenth of its bytes.
add_library(fmt::fmt INTERFACE IMPORTED GLOBAL)

# OpenGL, in epoxy's place.
add_library(PkgConfig::EPOXY INTERFACE IMPORTED GLOBAL)
set_target_properties(PkgConfig::EPOXY PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/client/web/stand_ins)

# These two and the codecs are most of the bytes that a page fetches, and little of its time: they are compiled to be small.

# Protobuf's lite runtime, of the sources that its own build says; of the version of protoc, which makes the messages.
set(PROTOBUF ${PROJECT_BINARY_DIR}/sources/protobuf)
find_program(PROTOC protoc REQUIRED)
file(STRINGS ${PROTOBUF}/src/google/protobuf/stubs/common.h PROTOBUF_VERSION REGEX "define GOOGLE_PROTOBUF_VERSION ")
string(REGEX REPLACE ".* [0-9]0*([0-9]+)0([0-9][0-9])$" "\\1.\\2" PROTOBUF_VERSION "${PROTOBUF_VERSION}")
execute_process(COMMAND ${PROTOC} --version OUTPUT_VARIABLE PROTOC_VERSION OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT PROTOC_VERSION MATCHES "${PROTOBUF_VERSION}$")
  message(FATAL_ERROR "Debian's source of Protobuf is ${PROTOBUF_VERSION}, the installed protoc says ${PROTOC_VERSION}")
endif()
file(READ ${PROTOBUF}/src/Makefile.am MAKEFILE)
string(REGEX MATCH "libprotobuf_lite_la_SOURCES =[^=]*" PROTOBUF_SOURCES "${MAKEFILE}")
string(REGEX MATCHALL "google/[a-z0-9_/]+\\.cc" PROTOBUF_SOURCES "${PROTOBUF_SOURCES}")
list(TRANSFORM PROTOBUF_SOURCES PREPEND ${PROTOBUF}/src/)
add_library(scree_web_protobuf STATIC ${PROTOBUF_SOURCES})
target_compile_features(scree_web_protobuf PUBLIC cxx_std_17)
target_compile_options(scree_web_protobuf PRIVATE -w -Oz)
target_include_directories(scree_web_protobuf SYSTEM PUBLIC ${PROTOBUF}/src)
add_library(protobuf::libprotobuf-lite ALIAS scree_web_protobuf)

# As FindProtobuf has it.
function(protobuf_generate_cpp SOURCES HEADERS)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE ALL)
  foreach(PROTO IN LISTS ARGN)
    string(REGEX REPLACE "\\.proto$" ".pb" MADE ${CMAKE_CURRENT_BINARY_DIR}/${PROTO})
    add_custom_command(
      OUTPUT ${MADE}.cc ${MADE}.h
      COMMAND ${PROTOC} --cpp_out ${CMAKE_CURRENT_BINARY_DIR} -I ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${PROTO}
      DEPENDS ${ALL}
      VERBATIM)
    list(APPEND MADE_SOURCES ${MADE}.cc)
    list(APPEND MADE_HEADERS ${MADE}.h)
  endforeach()
  set(${SOURCES} ${MADE_SOURCES} PARENT_SCOPE)
  set(${HEADERS} ${MADE_HEADERS} PARENT_SCOPE)
endfunction()

# zstd, as its own script makes one file of it.
set(ZSTD ${PROJECT_BINARY_DIR}/sources/libzstd)
set(ZSTD_SOURCE ${PROJECT_BINARY_DIR}/zstd.c)
find_program(PYTHON python3 REQUIRED)
add_custom_command(
  OUTPUT ${ZSTD_SOURCE}
  COMMAND ${PYTHON} combine.py -r ../../lib -x legacy/zstd_legacy.h -o ${ZSTD_SOURCE} zstd-in.c
  WORKING_DIRECTORY ${ZSTD}/build/single_file_libs
  VERBATIM)
add_library(scree_web_zstd STATIC ${ZSTD_SOURCE})
target_compile_options(scree_web_zstd PRIVATE -w -Os)
target_compile_definitions(scree_web_zstd PRIVATE ZSTD_STRIP_ERROR_STRINGS=1 ZSTD_NO_INLINE=1 HUF_FORCE_DECOMPRESS_X1=1
                                                  ZSTD_FORCE_DECOMPRESS_SEQUENCES_SHORT=1)
target_include_directories(scree_web_zstd SYSTEM PUBLIC ${ZSTD}/lib)
add_library(zstd::libzstd_shared ALIAS scree_web_zstd)
