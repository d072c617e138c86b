find_package(Threads REQUIRED)

# OpenVDB registers types by functions of std:: with its own lambdas as arguments. These are the same function in its
# library and in ours only where what they write is, too: sources that include its headers hide nothing.
function(scree_uses_openvdb TARGET)
  target_link_libraries(${TARGET} PRIVATE OpenVDB::openvdb)
  if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${TARGET} PRIVATE -fvisibility=default -fno-visibility-inlines-hidden -Wno-attributes)
  endif()
endfunction()

# Headers that many sources parse: scree_precompiled(NAME HEADER libraries whose flags they need …) compiles them once,
# and target_precompile_headers(TARGET REUSE_FROM NAME) hands the result to a target of the same flags. HEADER is a path from
# the project's folder.
function(scree_precompiled NAME HEADER)
  add_library(${NAME} OBJECT EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${NAME} PRIVATE scree_usage ${ARGN})
  target_precompile_headers(${NAME} PRIVATE <${HEADER}>)
  # Without times in it, a precompiled header that ccache kept fits sources that were checked out later.
  target_compile_options(${NAME} PRIVATE $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>)
endfunction()

# scree_as_one(RESULT NAME SOURCES…): a source NAME.cpp that includes these. It names them from the project's folder, as
# scree_usage's users include, so that a clone elsewhere has the same text, and takes what ccache kept of it.
function(scree_as_one RESULT NAME)
  set(TEXT)
  foreach(SOURCE IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH SOURCE BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    cmake_path(RELATIVE_PATH SOURCE BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(APPEND TEXT "#include \"${SOURCE}\"\n")
  endforeach()
  set(WHOLE ${CMAKE_CURRENT_BINARY_DIR}/${NAME}.cpp)
  file(CONFIGURE OUTPUT ${WHOLE} CONTENT "${TEXT}" @ONLY)
  set(${RESULT} ${WHOLE} PARENT_SCOPE)
endfunction()

# scree_unite(TARGET): with SCREE_UNITY the target's sources are compiled as one, which parses its headers once: names in
# anonymous namespaces are therefore different in all of them. This happens at the end of the folder's CMakeLists.txt. A
# source with the property SCREE_GROUP is one with those of its group, and with SCREE_APART it is compiled by itself, as
# those are that were generated.
function(scree_unite TARGET)
  if(SCREE_UNITY)
    cmake_language(EVAL CODE "cmake_language(DEFER CALL scree_unite_now [[${TARGET}]])")
  endif()
endfunction()
function(scree_unite_now TARGET)
  get_target_property(SOURCES ${TARGET} SOURCES)
  set(KEPT)
  set(GROUPS)
  foreach(SOURCE IN LISTS SOURCES)
    cmake_path(ABSOLUTE_PATH SOURCE BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    get_source_file_property(LEFT_OUT ${SOURCE} HEADER_FILE_ONLY)
    get_source_file_property(APART ${SOURCE} SCREE_APART)
    get_source_file_property(GROUP ${SOURCE} SCREE_GROUP)
    string(FIND ${SOURCE} ${PROJECT_BINARY_DIR}/ GENERATED)
    if(LEFT_OUT OR APART OR NOT SOURCE MATCHES "\\.(cpp|cc)$" OR (GENERATED EQUAL 0 AND NOT GROUP))
      list(APPEND KEPT ${SOURCE})
      continue()
    endif()
    if(NOT GROUP)
      set(GROUP all)
    endif()
    list(APPEND GROUPS ${GROUP})
    list(APPEND OF_${GROUP} ${SOURCE})
  endforeach()
  list(REMOVE_DUPLICATES GROUPS)
  foreach(GROUP IN LISTS GROUPS)
    scree_as_one(WHOLE ${TARGET}_${GROUP} ${OF_${GROUP}})
    list(APPEND KEPT ${WHOLE})
    foreach(SOURCE IN LISTS OF_${GROUP})
      string(FIND ${SOURCE} ${PROJECT_BINARY_DIR}/ GENERATED)
      if(GENERATED EQUAL 0)  # it is made before the whole is compiled
        set_source_files_properties(${SOURCE} PROPERTIES HEADER_FILE_ONLY ON)
        list(APPEND KEPT ${SOURCE})
      endif()
    endforeach()
  endforeach()
  set_target_properties(${TARGET} PROPERTIES SOURCES "${KEPT}" SCREE_UNITED "${OF_all}")
endfunction()

# One static library per folder, from every .cpp in it.
# Usage: scree_library(NAME [libraries to link …])
function(scree_library NAME)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(${NAME} STATIC ${SOURCES})
  target_link_libraries(${NAME} PUBLIC ${ARGN})
  target_precompile_headers(${NAME} REUSE_FROM scree_precompiled)
  scree_unite(${NAME})
endfunction()

# Options and reports: nobody waits for them to run, but for CLI11 and nlohmann's JSON to compile, which are headers
# only. They are compiled as one source, without optimisation, and by headers precompiled without it.
# Usage: scree_optimise_little(TARGET SOURCES…), sources of the target and of the folder that calls this
function(scree_optimise_little TARGET)
  if(NOT SCREE_UNITY)  # each source by itself
    target_sources(${TARGET} PRIVATE ${ARGN})
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release,Debug>:-O0>" SKIP_PRECOMPILE_HEADERS ON)
    return()
  endif()
  scree_as_one(WHOLE ${TARGET}_little ${ARGN})
  set_source_files_properties(${ARGN} PROPERTIES HEADER_FILE_ONLY ON)
  target_sources(${TARGET} PRIVATE ${WHOLE})
  set(HEADER ${PROJECT_BINARY_DIR}/CMakeFiles/scree_precompiled_little.dir/cmake_pch.hxx)
  set(PRECOMPILED ${HEADER}.gch)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    set(PRECOMPILED ${HEADER}.pch)
  endif()
  set_source_files_properties(${WHOLE} PROPERTIES
    COMPILE_OPTIONS "$<$<CONFIG:Release>:-O0>;-Winvalid-pch;-include;${HEADER}"
    OBJECT_DEPENDS ${PRECOMPILED}
    SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# Small rooms compile as one source as well: where each is a source, most of its time goes into headers that its
# neighbours parse, too. The rooms remain targets with their own links; the objects of all are in the library NAME.
# Names in anonymous namespaces are therefore different in all of them.
# Usage: scree_compile_together(NAME rooms…), after the rooms
function(scree_compile_together NAME)
  if(SCREE_WEB OR NOT SCREE_UNITY)
    return()
  endif()
  set(SOURCES)
  set(LITTLE)
  set(TOGETHER_LINK_LIBRARIES)
  set(TOGETHER_INCLUDE_DIRECTORIES)
  set(TOGETHER_COMPILE_DEFINITIONS)
  foreach(ROOM IN LISTS ARGN)
    get_target_property(FOLDER ${ROOM} SOURCE_DIR)
    get_target_property(ROOM_SOURCES ${ROOM} SOURCES)
    get_target_property(UNITED ${ROOM} SCREE_UNITED)
    list(APPEND SOURCES ${UNITED})
    foreach(SOURCE IN LISTS ROOM_SOURCES)
      get_source_file_property(LEFT_OUT ${SOURCE} DIRECTORY ${FOLDER} HEADER_FILE_ONLY)
      if(LEFT_OUT)
        continue()
      elseif(SOURCE MATCHES "_little\\.cpp$")
        list(APPEND LITTLE ${SOURCE})
      elseif(NOT SOURCE MATCHES "/${ROOM}_all\\.cpp$")
        continue()  # generated: the folder's own rule makes it
      endif()
      set_source_files_properties(${SOURCE} DIRECTORY ${FOLDER} PROPERTIES HEADER_FILE_ONLY ON)
    endforeach()
    foreach(LIST_NAME LINK_LIBRARIES INCLUDE_DIRECTORIES COMPILE_DEFINITIONS)
      get_target_property(VALUES ${ROOM} ${LIST_NAME})
      if(VALUES)
        list(APPEND TOGETHER_${LIST_NAME} ${VALUES})
      endif()
      list(REMOVE_DUPLICATES TOGETHER_${LIST_NAME})
    endforeach()
    set_target_properties(${ROOM} PROPERTIES LINKER_LANGUAGE CXX)
  endforeach()
  scree_as_one(WHOLE ${NAME} ${SOURCES})
  add_library(${NAME} STATIC ${WHOLE})
  target_link_libraries(${NAME} PRIVATE ${TOGETHER_LINK_LIBRARIES})
  target_include_directories(${NAME} SYSTEM PRIVATE ${TOGETHER_INCLUDE_DIRECTORIES})
  target_compile_definitions(${NAME} PRIVATE ${TOGETHER_COMPILE_DEFINITIONS})
  target_precompile_headers(${NAME} REUSE_FROM scree_precompiled)
  if(LITTLE)
    scree_optimise_little(${NAME} ${LITTLE})
  endif()
  foreach(ROOM IN LISTS ARGN)
    target_link_libraries(${ROOM} INTERFACE ${NAME})
  endforeach()
endfunction()

# False alarms of g++ 12 where strings are put together from literals (its bugs 105329 and 105651).
function(scree_silence_false_alarms)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    foreach(NAME IN LISTS ARGN)
      target_compile_options(${NAME} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
    endforeach()
  endif()
endfunction()

# A program that reads options.
function(scree_program NAME MAIN)
  add_executable(${NAME} ${MAIN})
  target_link_libraries(${NAME} PRIVATE ${ARGN} CLI11::CLI11 nlohmann_json::nlohmann_json)
  target_precompile_headers(${NAME} REUSE_FROM scree_precompiled)
  target_compile_definitions(${NAME} PRIVATE SCREE_VERSION="${PROJECT_VERSION}")  # for --version, which each has
  scree_optimise_little(${NAME} ${MAIN})
endfunction()

# A program that is a function of its library.
function(scree_program_of_library NAME MAIN)
  add_executable(${NAME} ${MAIN})
  target_link_libraries(${NAME} PRIVATE ${ARGN})
endfunction()

# Asio, compiled once. What its headers define depends on these: every target in one program must say the same.
# Without ASIO_DISABLE_STD_ALIGNED_ALLOC it would go by what happens to be included before: memory from malloc, given
# to delete.
add_library(scree_asio STATIC EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/cmake/asio.cpp)
target_compile_definitions(scree_asio PUBLIC ASIO_STANDALONE ASIO_NO_DEPRECATED ASIO_DISABLE_STD_ALIGNED_ALLOC
                                             ASIO_SEPARATE_COMPILATION)
target_link_libraries(scree_asio PUBLIC scree_usage Threads::Threads)
