/** @file
 * A client of Scree, for programs in any language: it joins a server of destructible terrain, keeps a copy of
 * the server's world up to date, sends requests, and makes meshes.
 *
 * Use: scree_client_create(); then scree_client_poll() once a frame, and scree_client_next() until it says
 * SCREE_NOTHING. The copy is as of the event that was told last. The client answers the server by itself.
 *
 * Values. Lengths are metres, y points up, rotations are unit quaternions (x, y, z, w). A triple of integers
 * that names a voxel, a brick (8 voxels a side) or a chunk (32 voxels a side) counts from the world's origin.
 * Text is UTF-8 and ends with 0. Each struct that the caller makes begins with its size: set it to sizeof,
 * and everything else to 0 or by the struct's init function. A later release may add members at the end of a
 * struct, and kinds.
 *
 * Errors. Functions return SCREE_OK (0), SCREE_NOTHING (1), or an error below 0; scree_error() has the words.
 * A null handle, a struct of no known size or a number that is not finite is SCREE_INVALID. No function
 * throws, and nothing that a server sends ends the process.
 *
 * Memory. What an event or a mesh points to belongs to the library: it holds until the next call of the
 * function that gave it, or until it is released.
 *
 * Threads. One thread at a time uses a client and its meshers; different clients may be used by different
 * threads. Callbacks come within scree_client_next(); they may not poll or take events, and a client that
 * they destroy ends after them. docs/clients.md has bounds of numbers, and the roles that requests take. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#if defined(SCREE_BUILDS_LIBRARY) && defined(__GNUC__)
#define SCREE_API __attribute__((visibility("default")))
#else
#define SCREE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif
/** @defgroup results Results
 * What every function returns, and its words.
 * @{ @snippet groups.c results */

typedef int32_t scree_result;
enum {
  SCREE_OK = 0,
  SCREE_NOTHING = 1,        /**< there is none, or none yet */
  SCREE_INVALID = -1,       /**< an argument that no call may have */
  SCREE_NOT_CONNECTED = -2, /**< there is no connection, or there has been none yet */
  SCREE_NO_MEMORY = -3,     /**< the allocator gave none */
  SCREE_TOO_SMALL = -4,     /**< the caller's array has too little room: the count says how much it takes */
  SCREE_REFUSED = -5        /**< the library cannot do this, for a reason that scree_error() tells */
};

/** Why the last call on this thread that returned an error did so, in words; "" before the first. Valid until
 * the thread's next call of the library. */
SCREE_API const char* scree_error(void);
/** The version of the library, "0.2.0", and that of the protocol that it speaks (docs/protocol.md). */
SCREE_API const char* scree_version(void);
SCREE_API uint32_t scree_protocol(void);
/** @} */
/** @defgroup client The client
 * Its life: options, connection, waiting.
 * @{ @snippet groups.c client */

typedef struct scree_client scree_client;

/** Where arrays that are handed out come from. `allocate` returns null where there is no memory; it may be
 * called by the library's threads. Both are set, or neither: then malloc() and free(). */
typedef struct scree_allocator {
  void* user;
  void* (*allocate)(void* user, size_t bytes, size_t alignment);
  void (*release)(void* user, void* memory, size_t bytes);
} scree_allocator;

enum scree_flag {
  SCREE_TLS = 1 << 0,            /**< the connection is encrypted */
  SCREE_INSECURE_TOKEN = 1 << 1, /**< the token may go to another machine without TLS */
  SCREE_AT_SPAWN = 1 << 2,       /**< the server says the eye's place, where its world has one for visitors */
  SCREE_PREDICT = 1 << 3,        /**< requests show their probable result before the server answers */
  SCREE_SMOOTH = 1 << 4,         /**< messages wait a little, so that motions are even: for drawing */
  SCREE_STONES = 1 << 5, /**< tells where pieces became terrain, also those from before (SCREE_EVENT_STONE) */
  SCREE_ONCE = 1 << 6,   /**< a lost connection is not tried again */
  SCREE_MEETS = 1 << 7   /**< it is a person's: hears lines and learns who is there */
};

typedef struct scree_options {
  uint32_t size;
  uint32_t flags;           /**< of scree_flag */
  const char* host;         /**< null: "127.0.0.1" */
  uint32_t port;            /**< 0: 4177 */
  uint32_t connect_ms;      /**< what an attempt may take; 0: as the library thinks right */
  const char* ca_file;      /**< PEM, trusted instead of the system's authorities; null: the system's */
  const char* fingerprint;  /**< SHA-256 of the one certificate that is trusted, in hexadecimal; null: any */
  const char* token;        /**< an access token; null: none */
  const char* name;         /**< the person's, shown to others; null: none */
  const char* program;      /**< for the server's log; null: "libscree_client" */
  float eye_m[3];           /**< the middle of what the client follows */
  float radius_m;           /**< how far; 0: 96 m. The server may grant less */
  const char* cache_folder; /**< keeps edits for the next visit; null: in memory only */
  uint64_t cache_bytes;     /**< of edits that are kept for the next connection; 0: none */
  float contacts_j;         /**< blows of at least so much energy are told (SCREE_EVENT_CONTACT); 0: none */
  scree_allocator allocator;
} scree_options;
/** Sets size, and what a program means that says nothing. */
SCREE_API scree_result scree_options_init(scree_options* options, uint32_t size);
/** Makes a client and begins to connect: SCREE_EVENT_JOINED or SCREE_EVENT_LOST tells the outcome. */
SCREE_API scree_result scree_client_create(const scree_options* options, scree_client** client);
/** Says goodbye, ends its meshers, and waits for the library's threads. Null: does nothing. */
SCREE_API void scree_client_destroy(scree_client* client);
/** Takes in what has come; waits for it up to so many milliseconds. 0: does not wait. */
SCREE_API scree_result scree_client_poll(scree_client* client, uint32_t wait_ms);
/** @} */
/** @defgroup events Events
 * What happened, in order.
 * @{ @snippet groups.c events */

enum scree_event_kind {
  SCREE_EVENT_JOINED =
      1,               /**< session, tick; flags bit 0: another world than the last, bit 1: a recording. The
                        * copy is a new one: forget meshes and bodies. Meshers begin anew by themselves */
  SCREE_EVENT_LOST,    /**< text: why; name: of the refusal; flags bit 0: there is no other attempt */
  SCREE_EVENT_FRAME,   /**< tick: the copy is as of it */
  SCREE_EVENT_TERRAIN, /**< coords: bricks that changed */
  SCREE_EVENT_PIECE_ADDED,   /**< id */
  SCREE_EVENT_PIECE_REMOVED, /**< id: it became terrain, or is out of sight */
  SCREE_EVENT_BODY_ADDED,    /**< id: a prop of the game, or the body of a person */
  SCREE_EVENT_BODY_REMOVED,  /**< id */
  SCREE_EVENT_STONE,   /**< id: of a piece that became terrain where it lies, by position and rotation */
  SCREE_EVENT_REPLY,   /**< request, tick; text: the refusal, or ""; name: for programs; id, number */
  SCREE_EVENT_STATUS,  /**< once a second: scree_client_status() is new */
  SCREE_EVENT_PALETTE, /**< scree_client_material() has other answers */
  SCREE_EVENT_SAID,    /**< session, name, text: a line of a person, or of the server (session 0) */
  SCREE_EVENT_PERSON,  /**< session, name; number: the role. flags bit 0: the list of all begins anew */
  SCREE_EVENT_MESSAGE, /**< name: channel; data: bytes of the game's rules */
  SCREE_EVENT_SIGN,    /**< name, text, position; number: 0 a line, 1 a bar, 2 a marker; value: a bar's share.
                        * flags bit 0: the first of all there are; an empty name: there is none */
  SCREE_EVENT_CUE,     /**< name: what sounds or is seen; position */
  SCREE_EVENT_CONTACT  /**< id: a body; number: the other one, or 0: the terrain; position; value: joules */
};

typedef struct scree_event {
  uint32_t size;
  uint32_t kind; /**< of scree_event_kind */
  uint32_t flags;
  uint32_t request; /**< its number, as scree_client_request() gave it */
  uint64_t tick, session;
  int64_t number; /**< of a reply: pieces that it made at once, or units of mass that were dug or placed */
  uint32_t id;    /**< of a reply: the body that was added, else 0 */
  float value;
  float position[3], rotation[4];
  const char *name, *text; /**< never null */
  const uint8_t* data;     /**< null: none */
  size_t data_bytes;
  const int32_t* coords; /**< triples; null: none */
  size_t coord_count;
} scree_event;

/** Takes the next event. SCREE_NOTHING: none is left until the next poll. Set event->size before. */
SCREE_API scree_result scree_client_next(scree_client* client, scree_event* event);
/** @} */
/** @defgroup requests Requests
 * What a client asks the server for.
 * @{ @snippet groups.c requests */

enum scree_shape_kind { SCREE_SPHERE, SCREE_BOX, SCREE_CAPSULE, SCREE_CRATER };

/** sphere and crater: middle a, radius. box: middle a, half of its sides b, edges rounded by the radius.
 * capsule: from a to b, radius. */
typedef struct scree_shape {
  uint32_t kind;
  float a_m[3], b_m[3], radius_m;
} scree_shape;

enum scree_request_kind {
  SCREE_CARVE = 1, /**< shape, pattern, seeds, random_seed, place_m: of the blow, speed_m_s: of the pieces */
  SCREE_FILL,      /**< shape, material or none: as the ground around */
  SCREE_PAINT,     /**< shape, material */
  SCREE_BLAST,     /**< place_m, energy_j, random_seed */
  SCREE_DIG,       /**< shape, or body: a piece; goes into the own store */
  SCREE_PLACE,     /**< shape, material, flags bit 0: solid, else as rubble; out of the own store */
  SCREE_CUT_OUT,   /**< shape: becomes a body that never merges until it is released */
  SCREE_RELEASE,   /**< body: a piece that was cut out */
  SCREE_BREAK,     /**< body: a piece; place_m, seeds, random_seed */
  SCREE_PUSH,      /**< body, place_m, vector: impulse in N s */
  SCREE_ADD_BODY,  /**< shape: a sphere or a box, whose own place does not count; place_m, rotation, vector:
                    * its speed, mass_kg or 0: by its material, material, motion */
  SCREE_REMOVE_BODY, /**< body */
  SCREE_MOVE_BODY,   /**< body, place_m, rotation, vector: its speed */
  SCREE_STAND,       /**< enters the world on foot; flags bit 0: leaves it */
  SCREE_GIVE         /**< all of the own store goes to the world's */
};

#define SCREE_NO_MATERIAL 0xFFFFFFFFU

typedef struct scree_request {
  uint32_t size;
  uint32_t kind; /**< of scree_request_kind */
  uint32_t flags;
  uint32_t material; /**< its number (scree_client_find_material()), or SCREE_NO_MATERIAL */
  scree_shape shape;
  uint32_t pattern; /**< scree_find_pattern() */
  uint32_t seeds, random_seed;
  uint32_t body;
  float place_m[3], rotation[4], vector[3];
  float speed_m_s, energy_j, mass_kg;
  uint32_t motion; /**< 0: moves by forces; 1: as it is told; 2: stands still */
  uint64_t tag;    /**< of a body: the game's own */
} scree_request;
/** Sets size and kind, and what a request of that kind has that says nothing. */
SCREE_API scree_result scree_request_init(scree_request* request, uint32_t size, uint32_t kind);

typedef void (*scree_reply_function)(void* user, const scree_event* reply);

/** Sends a request. `number`, which may be null, gets the request's number. Its reply comes as
 * SCREE_EVENT_REPLY, or to the function, if there is one, and then not as an event. Where the connection ends
 * first, the reply's name is "connection_lost": the server may have carried it out. */
SCREE_API scree_result scree_client_request(scree_client* client, const scree_request* request,
                                            scree_reply_function reply, void* user, uint32_t* number);

/** Moves the middle of what the client follows, and how far it follows. */
SCREE_API scree_result scree_client_follow(scree_client* client, const float eye_m[3], float radius_m);
/** A line to all persons. */
SCREE_API scree_result scree_client_say(scree_client* client, const char* text);
/** Bytes for the game's rules. */
SCREE_API scree_result scree_client_send(scree_client* client, const char* channel, const void* data,
                                         size_t bytes);
/** One tick on foot, after SCREE_STAND: a way along the world's x and z of length 1 at most, buttons (bit 0:
 * jump, bit 1: run) and where one looks. Call it once for each tick of the server's (tick_rate_hz).
 * SCREE_NOTHING: the person is not on foot, or the server has not taken what it was sent. */
SCREE_API scree_result scree_client_walk(scree_client* client, const float way[2], uint32_t buttons,
                                         const float look[3]);

/** The number of a pattern of seeds by its name, such as "natural"; SCREE_NOTHING: there is none. */
SCREE_API scree_result scree_find_pattern(const char* name, uint32_t* pattern);
/** @} */
/** @defgroup world The world
 * The client's copy of it.
 * @{ @snippet groups.c world */

typedef struct scree_status {
  uint32_t size, connected; /**< connected: 1, or 0 */
  uint64_t session, tick;   /**< the copy is as of the tick */
  uint32_t tick_rate_hz;
  uint32_t role; /**< 0 looks, 1 carves, 2 builds, 4 directs, 3 administers: in order of power */
  float voxel_m;
  float radius_m;          /**< as granted */
  float eye_m[3];          /**< the middle of what is followed */
  uint32_t loaded;         /**< 1: the edits around seem to have arrived */
  uint32_t pieces, bodies; /**< that are known here */
  uint32_t predictions;    /**< requests that are shown and not answered */
  uint32_t on_foot;        /**< 1: this client's person is on foot */
  float feet_m[3];         /**< then: where */
  uint32_t held_chunks;    /**< that follow the server */
  uint64_t edited_bricks;  /**< in them */
  uint64_t field_hash;     /**< of all edits that are here; a server's own, when all of its edits are */
  uint64_t server_tick, server_hash; /**< of all edits, by the server's last status, as all below; 0: none */
  /** In units of mass: 1/254 of a voxel. */
  int64_t ledger_terrain, ledger_pieces, ledger_dust, ledger_poured, ledger_stored;
  uint64_t received_bytes, sent_bytes;
  uint64_t mismatches; /**< frames whose check failed; the chunks were asked for again */
  float spawn_look[3]; /**< where who begins looks, unit; 0: the server does not say */
} scree_status;

SCREE_API scree_result scree_client_status(scree_client* client, scree_status* status);
typedef struct scree_body {
  uint32_t id;
  uint32_t kind; /**< 0: a piece; 1: a prop; 2: the body of a person */
  float position[3], rotation[4];
} scree_body;

/** Poses at a tick and its fraction, ordered by kind, then id; below 0: the newest ones. `count` gets how
 * many there are. SCREE_TOO_SMALL: more than `room`. */
SCREE_API scree_result scree_client_bodies(scree_client* client, double tick, scree_body* bodies, size_t room,
                                           size_t* count);
/** The same as columns, each with `room` for bodies, as a GPU takes them. What is null is left out. */
typedef struct scree_body_columns {
  uint32_t size;
  uint32_t* ids;
  uint8_t* kinds;
  float *positions, *rotations; /**< three and four a body */
} scree_body_columns;
SCREE_API scree_result scree_client_body_columns(scree_client* client, double tick,
                                                 const scree_body_columns* columns, size_t room,
                                                 size_t* count);
/** The tick, with its fraction, at which to draw now; of a client with SCREE_SMOOTH. */
SCREE_API scree_result scree_client_draw_tick(scree_client* client, double* tick);

/** A prop, as who added it made it, or the body of a person. */
typedef struct scree_prop {
  uint32_t size, motion, material; /**< motion as in scree_request */
  float mass_kg;                   /**< 0: by its material */
  uint64_t tag, session;           /**< the game's own; whose body it is, or 0 */
  const uint8_t* data;             /**< the game's own, valid until the next poll; null: none */
  size_t data_bytes;
} scree_prop;
/** SCREE_NOTHING: there is none of that id. */
SCREE_API scree_result scree_client_prop(scree_client* client, uint32_t id, scree_prop* prop);
typedef struct scree_material {
  uint32_t size;
  float colour[3]; /**< linear, 0 to 1 */
  float roughness, density_kg_m3, friction;
  const char* name; /**< valid until the next poll */
} scree_material;

/** A row of the palette by number, the number of a row, and units of mass in the own store. */
SCREE_API scree_result scree_client_material(scree_client* client, uint32_t number, scree_material* material);
SCREE_API scree_result scree_client_find_material(scree_client* client, const char* name, uint32_t* number);
SCREE_API scree_result scree_client_carried(scree_client* client, uint32_t material, int64_t* mass);
/** @} */
/** @defgroup questions Questions
 * About space, asked of the copy, without the server.
 * @{ @snippet groups.c questions */

enum scree_mask { SCREE_MASK_TERRAIN = 1, SCREE_MASK_PIECES = 2, SCREE_MASK_BODIES = 4, SCREE_MASK_ALL = 7 };

typedef struct scree_hit {
  uint32_t size;
  uint32_t kind;     /**< 0: terrain; 1: a piece; 2: a body */
  uint32_t id;       /**< of a piece or a body */
  uint32_t material; /**< of terrain and pieces */
  float distance_m;
  float place_m[3], normal[3];
  uint32_t inside; /**< 1: the cast began within it */
  uint32_t exact;  /**< 0: part lies beyond what is followed, or has not arrived */
} scree_hit;

/** Where a ball of that radius that goes along a unit vector hits; radius 0: a ray. SCREE_NOTHING: none. */
SCREE_API scree_result scree_client_cast(scree_client* client, const float from_m[3], const float unit[3],
                                         float most_m, float radius_m, uint32_t mask, scree_hit* hit);
/** The nearest surface. SCREE_NOTHING: none is so near. */
SCREE_API scree_result scree_client_nearest(scree_client* client, const float place_m[3], float most_m,
                                            uint32_t mask, scree_hit* hit);
/** Ids of pieces and bodies in a ball; `terrain` gets 1 if rock is in it, else 0. */
SCREE_API scree_result scree_client_overlap(scree_client* client, const float place_m[3], float radius_m,
                                            uint32_t mask, uint32_t* terrain, uint32_t* ids, size_t room,
                                            size_t* count);
/** Signed distances of places (triples) to the terrain's surface, below 0 in rock; three voxels at most. */
SCREE_API scree_result scree_client_distances(scree_client* client, const float* places_m, size_t count,
                                              float* distances_m);
/** Codes of the voxels of a box (lo in it, hi not), z fastest: −127 to 127, in 1/42 voxel, below 0 in rock.
 * At most 2^24 voxels. `room`: of codes; not less than the box has. */
SCREE_API scree_result scree_client_codes(scree_client* client, const int32_t lo[3], const int32_t hi[3],
                                          int8_t* codes, size_t room);
/** @} */
/** @defgroup meshes Meshes
 * Of terrain and pieces, as flat arrays.
 * @{ @snippet groups.c meshes */

/** Triangles, counter-clockwise seen from the air. Arrays go into a GPU's buffers as they are. */
typedef struct scree_mesh {
  uint32_t size;
  uint32_t kind;     /**< 0: terrain; 1: a piece; 2: a prop */
  uint32_t id;       /**< of a piece or a prop */
  int32_t level;     /**< of terrain: a cell has 2^level voxels a side */
  int32_t node[3];   /**< of terrain: which block of 16 cells a side of that level */
  uint32_t flags;    /**< bit 0: gone, and nothing takes its place; bit 1: the last of an update */
  float origin_m[3]; /**< terrain: of the positions in the world. A piece's are about its centre of mass, so
                      * that its pose places them */
  size_t vertex_count, index_count;
  const float *positions, *normals; /**< 3 a vertex: metres from the origin; unit */
  const uint8_t *materials,
      *shades;             /**< 1 a vertex: row of the palette; 255 in the open, less in a crevice */
  const uint32_t* indices; /**< 3 a triangle */
} scree_mesh;

typedef struct scree_mesher scree_mesher;

typedef struct scree_mesher_options {
  uint32_t size;
  uint32_t threads; /**< 0: as many as there are cores */
  float radius_m;   /**< of the finest detail twice; coarser ones reach eight times as far; 0: 64 m */
  uint32_t method;  /**< 0: surface nets; 1: dual contouring; 2: marching cubes */
  uint32_t rounded; /**< 1: edges are left round; 0: sharp within a tenth of a voxel */
} scree_mesher_options;

SCREE_API scree_result scree_mesher_options_init(scree_mesher_options* options, uint32_t size);
/** Meshes terrain around an eye, and pieces, on its own threads. It begins with all that is there. */
SCREE_API scree_result scree_mesher_create(scree_client* client, const scree_mesher_options* options,
                                           scree_mesher** mesher);
SCREE_API void scree_mesher_destroy(scree_mesher* mesher);
/** Call once a frame after the events. Begins new work; takes finished work, if there is any, all of which is
 * to be shown at once: then there is never a crack, or a piece beside the rock that it has become. An update
 * that was not taken to its end goes on. SCREE_NOTHING: no update. */
SCREE_API scree_result scree_mesher_update(scree_mesher* mesher, const float eye_m[3]);
/** The next mesh of the update, which replaces the one of the same level and node, or piece. Its arrays hold
 * until the next call. SCREE_NOTHING: that was the last. */
SCREE_API scree_result scree_mesher_next(scree_mesher* mesher, scree_mesh* mesh);
/** 1: all is meshed in its newest state; 0: work is left. */
SCREE_API scree_result scree_mesher_complete(scree_mesher* mesher, uint32_t* complete);

/** The mesh of one chunk by surface nets, of voxels. Release it. SCREE_NOTHING: it has no surface. */
SCREE_API scree_result scree_client_mesh_chunk(scree_client* client, const int32_t chunk[3],
                                               scree_mesh* mesh);
/** The mesh of one piece, or of a prop's form, likewise. */
SCREE_API scree_result scree_client_mesh_body(scree_client* client, uint32_t id, scree_mesh* mesh);
SCREE_API void scree_mesh_release(scree_client* client, scree_mesh* mesh);
/** @} */

#ifdef __cplusplus
}
#endif
