// The grids of OpenVDB that files hold. Their virtual functions are in its library, whose initialize()
// registers them: sources that include this do not compile them again, which is most of what such a source
// takes. Internal to import/vdb and export/vdb.
#pragma once

#include <openvdb/openvdb.h>

// The library lacks the small functions that its own compiler inlined; so does g++ here, but not unoptimised,
// and clang makes no promise.
#if defined(__OPTIMIZE__) && !defined(__clang__)
namespace openvdb::OPENVDB_VERSION_NAME {

extern template class Grid<FloatTree>;
extern template class Grid<Int32Tree>;
extern template class Grid<DoubleTree>;
extern template class tree::Tree<FloatTree::RootNodeType>;
extern template class tree::Tree<Int32Tree::RootNodeType>;
extern template class tree::Tree<DoubleTree::RootNodeType>;

}  // namespace openvdb::OPENVDB_VERSION_NAME
#endif
