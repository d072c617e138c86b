# One static library per folder, from every .cpp in it. Usage: scree_library(NAME [libraries to link …])
function(scree_library NAME)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(${NAME} STATIC ${SOURCES})
  target_link_libraries(${NAME} PUBLIC ${ARGN})
endfunction()

# Asio is headers only, and what they define depends on these: every target in one program must say the same.
# Without the last it would go by what happens to be included before: memory from malloc, given to delete.
function(scree_uses_asio NAME)
  target_compile_definitions(${NAME} PRIVATE ASIO_STANDALONE ASIO_NO_DEPRECATED ASIO_DISABLE_STD_ALIGNED_ALLOC)
  target_link_libraries(${NAME} PRIVATE Threads::Threads)
endfunction()
