"""Shows Scree's types in gdb: coordinates, boxes, bricks, windows, operations, fields.

    (gdb) source tools/debug/scree_gdb.py
    (gdb) print brick
    (gdb) scree-slice window y 12

docs/develop.md explains both. The command line works as well: gdb -x tools/debug/scree_gdb.py PROGRAM.
"""

import gdb
import gdb.printing

BRICK = 8  # voxels a side (shared/field/coord.h)
AIR, SOLID = 127, -127  # codes (shared/field/brick.h)


def coord(value):
    return tuple(int(value[name]) for name in "xyz")


def text_of(point):
    return "(%d, %d, %d)" % point


def referred(value):
    """The object itself, where the value is a reference to it."""
    references = (gdb.TYPE_CODE_REF, gdb.TYPE_CODE_RVALUE_REF)
    return value.referenced_value() if value.type.strip_typedefs().code in references else value


def name_of_type(value):
    return value.type.strip_typedefs().unqualified().name


def codes_at(address, count):
    """Codes from the program's memory, as signed numbers; one read, because a window has a million."""
    if count == 0:
        return memoryview(b"").cast("b")
    return memoryview(bytes(gdb.selected_inferior().read_memory(int(address), count))).cast("b")


def codes_of_brick(value):
    return codes_at(value["codes"].address, BRICK**3)


def codes_of_window(value):
    storage = value["codes"]["_M_impl"]
    start, finish = storage["_M_start"], storage["_M_finish"]
    return codes_at(start, int(finish) - int(start))


def summary(codes):
    """How full a volume is. A code is negative inside rock."""
    if len(codes) == 0:
        return "no voxels"
    low, high = min(codes), max(codes)
    if low == high == AIR:
        return "all air"
    if low == high == SOLID:
        return "all rock"
    rock = sum(1 for code in codes if code < 0)
    return "%d of %d voxels in rock, codes %d to %d" % (rock, len(codes), low, high)


def size_of_box(value):
    low, high = coord(value["lo"]), coord(value["hi"])
    return tuple(h - l for l, h in zip(low, high))


def text_of_box(value):
    return "%s to %s, %d x %d x %d voxels" % (
        (text_of(coord(value["lo"])), text_of(coord(value["hi"]))) + size_of_box(value)
    )


def cell(code):
    """One voxel in four columns: # is rock beyond the narrow band, . is air beyond it."""
    if code == SOLID:
        return "   #"
    if code == AIR:
        return "   ."
    return "%4d" % code


def slice_lines(codes, size, axis, at):
    """The voxels of a box at one coordinate of an axis, a row a line, from the upper row down."""
    fixed = "xyz".index(axis)
    across, down = {0: (2, 1), 1: (2, 0), 2: (0, 1)}[fixed]
    lines = []
    for row in reversed(range(size[down])):
        cells = []
        for column in range(size[across]):
            place = [0, 0, 0]
            place[fixed], place[across], place[down] = at, column, row
            cells.append(cell(codes[(place[0] * size[1] + place[1]) * size[2] + place[2]]))
        lines.append("".join(cells))
    return lines


class PointPrinter:
    """A coordinate, or a vector of GLM's, whose members are unions."""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        return "(%s, %s, %s)" % tuple(self.value[name].format_string() for name in "xyz")


class BoxPrinter:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return "box " + text_of_box(self.value)


class BrickPrinter:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return "brick: " + summary(codes_of_brick(self.value))


class WindowPrinter:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        return "window %s: %s" % (text_of_box(self.value["box"]), summary(codes_of_window(self.value)))


class OperationPrinter:
    """The kind of the operation, and its members. The variant's alternatives lie at its beginning."""

    def __init__(self, value):
        self.value = value

    def kind(self):
        return referred(self.value).type.strip_typedefs().template_argument(int(self.value["_M_index"]))

    def to_string(self):
        name = self.kind().name.replace("scree::", "").replace("Operation", "")
        return "operation " + name.lower()

    def children(self):
        held = self.value["_M_u"].address.cast(self.kind().pointer()).dereference()
        for field in held.type.fields():
            if not getattr(field, "is_base_class", False) and hasattr(field, "bitpos"):
                yield field.name, held[field]


class FieldPrinter:
    """What a field holds. Its bricks are read by its own functions: call field.brick({1, 2, 3})."""

    def __init__(self, value):
        self.value = referred(value)

    def to_string(self):
        value = self.value
        edited = int(value["edited_"]["_M_h"]["_M_element_count"])
        text = "%s: %d edited bricks in %d chunks, hash %016x" % (
            value.dynamic_type.strip_typedefs().unqualified().name.replace("scree::", ""),
            int(value["edited_bricks_"]),
            edited,
            int(value["hash_"]),
        )
        if int(value["below_"]) != 0:
            text += ", a layer over the field at 0x%x" % int(value["below_"])
        kept = sum(
            int(value["generated_"][name]["chunks"]["_M_h"]["_M_element_count"])
            for name in ("used_", "unused_")
        )
        return text + ", %d generated chunks" % kept


def printers():
    collection = gdb.printing.RegexpCollectionPrettyPrinter("scree")
    collection.add_printer("coordinate", r"^scree::Coord<.*>$", PointPrinter)
    collection.add_printer("vector", r"^glm::vec<3, .*>$", PointPrinter)
    collection.add_printer("box", r"^scree::VoxelBox$", BoxPrinter)
    collection.add_printer("brick", r"^scree::Brick$", BrickPrinter)
    collection.add_printer("window", r"^scree::Window$", WindowPrinter)
    collection.add_printer("operation", r"^std::variant<scree::CarveOperation, .*>$", OperationPrinter)
    collection.add_printer("field", r"^scree::(Vdb|Map)?Field$", FieldPrinter)
    return collection


class SliceCommand(gdb.Command):
    """Prints a slice of a brick or of a window: scree-slice EXPRESSION x|y|z AT

AT is a voxel's coordinate along that axis; in a brick it is 0 to 7. Numbers are codes; # is rock and . is air,
both beyond the narrow band. The upper row is the highest coordinate."""

    def __init__(self):
        super().__init__("scree-slice", gdb.COMMAND_DATA, gdb.COMPLETE_EXPRESSION)

    def invoke(self, argument, from_tty):
        words = argument.rsplit(None, 2)
        if len(words) != 3 or words[1] not in ("x", "y", "z"):
            raise gdb.GdbError("usage: scree-slice EXPRESSION x|y|z AT")
        value = referred(gdb.parse_and_eval(words[0]))
        at = int(gdb.parse_and_eval(words[2]))
        name = name_of_type(value)
        if name == "scree::Brick":
            low, size, codes = (0, 0, 0), (BRICK,) * 3, codes_of_brick(value)
        elif name == "scree::Window":
            low, size = coord(value["box"]["lo"]), size_of_box(value["box"])
            codes = codes_of_window(value)
        else:
            raise gdb.GdbError("%s is neither a scree::Brick nor a scree::Window" % name)
        axis = "xyz".index(words[1])
        if not 0 <= at - low[axis] < size[axis]:
            raise gdb.GdbError(
                "%s = %d lies outside: %d to %d" % (words[1], at, low[axis], low[axis] + size[axis] - 1)
            )
        print("\n".join(slice_lines(codes, size, words[1], at - low[axis])))


def register(objfile):
    # Beside each program and library: printers that belong to one come before general ones, and the standard
    # library's own would show an operation as any variant.
    gdb.printing.register_pretty_printer(objfile, printers(), replace=True)


for loaded in gdb.objfiles():
    register(loaded)
gdb.events.new_objfile.connect(lambda event: register(event.new_objfile))
SliceCommand()
