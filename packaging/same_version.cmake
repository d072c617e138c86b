# CPack reads this before it makes packages, when it knows the version that it was given: packages of one build belong
# together where one has a part of another.
set(SAME "(= ${CPACK_PACKAGE_VERSION})")
string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libscree-client0 ${SAME}")
string(PREPEND CPACK_DEBIAN_CPP_PACKAGE_DEPENDS "libscree-client-dev ${SAME}, ")
