// The client in a browser, as the page sees it: C functions of scree.wasm. The page (client/web/page) owns
// the WebSocket, the elements, the keys and the fingers; all else is here: the protocol, the mirror of the
// world, the camera, the drawing, reconnecting.
//
// scree.js is an ES module whose default export makes the client: `const client = await createScree({canvas,
// wasmBinary, readModel})`. It gets the bytes of scree.wasm, so that the page can show how much of them has
// come. `readModel` reads models of props (page/glb.js); this side calls it in scree_frame(). Numbers go by
// client._scree_NAME(…), texts by client.ccall("scree_NAME", result, types, values).
//
// All calls are from the page's one thread, never from within each other. Nothing waits and nothing throws.
// Texts are UTF-8 and end in NUL. A text that is returned belongs to this side and holds until the same
// function is called again; of a text that is passed nothing is kept. Functions that return an int and say no
// more return 1 when it was done, and 0 when the argument is none that they know, which changes nothing.
// Lengths are metres, angles degrees, times seconds, unless a name says otherwise. Numbers that are not
// finite are refused.
//
// Order: scree_begin(), the wishes that the page's address has (camera, method, token …), then scree_frame()
// in every animation frame. Everything else may be called at any time after scree_begin(), before the first
// connection, too.
#pragma once

#include <cstdint>

extern "C" {

// ---- life

/// Makes the WebGL 2 context of `canvas`, a CSS selector ("#view"), and whatever draws in it. 0: done. 1: the
/// browser has no WebGL 2, or refuses it now. 2: something else, as scree_error() says. After 1 or 2 nothing
/// else may be called but scree_error().
int scree_begin(const char* canvas);
/// What failed, in words for people; empty: nothing did. What scree_frame() met is here, too.
const char* scree_error();
/// Says goodbye to the server, as far as a page that is closed can: call it on "pagehide", then send
/// scree_outgoing().
void scree_leave();

// ---- the WebSocket: path /session of the page's own server, binary messages

/// What is to be done with the socket; ask after every frame. 0: nothing. 1: open one. It is asked once for
/// each attempt, and never while one is open or opening; this side decides whether and when to try again. 2:
/// close it. After 2, or when a socket is replaced, nothing of the old socket may be passed on.
int scree_socket_wish();
/// The socket is open: the hello waits in scree_outgoing().
void scree_socket_opened();
/// The socket is closed, or could not be opened; `why` in words for people, possibly empty.
void scree_socket_closed(const char* why);
/// Memory for the bytes of one binary message, null for one over limits::page_message_bytes_max; then
/// scree_received() with as many. They are only kept: the work is done in scree_frame(), under its budget.
uint8_t* scree_incoming(uint32_t bytes);
void scree_received(uint32_t bytes);
/// The bytes that wait to be sent, as one binary message: how many, and then where. Ask after every frame,
/// and after scree_socket_opened(). The first call takes them: they hold until it is called again.
uint32_t scree_outgoing();
const uint8_t* scree_outgoing_bytes();

// ---- the picture

/// The size of the drawing buffer, pixels of the device; the page sets canvas.width and canvas.height to the
/// same.
void scree_resize(int width, int height);
/// One animation frame: takes in messages, moves the camera, draws. 1: drawn. 0: it cannot go on,
/// scree_error() says why (a context that was lost among others): the page offers to load itself anew.
int scree_frame();

/// How many errors WebGL has reported; asking waits for the GPU. scree_state() says as many as were known
/// when this was called last.
uint32_t scree_gl_errors();

// ---- wishes; also from the page's address

/// The person's name, and the token that goes with the hello; from the next connection on.
int scree_set_name(const char* name);
int scree_set_token(const char* token);
/// "x,y,z,yaw,pitch", as the viewer's --camera, in metres and degrees. Without it the camera begins where the
/// ground says.
int scree_set_camera(const char* text);
const char* scree_camera();
/// A method by its name (scree_catalogue()); 0: there is none, or this browser cannot draw it.
int scree_set_method(const char* name);
/// "low", "medium", "high" or "auto": by the time that the first frames take.
int scree_set_quality(const char* name);
/// How far terrain is drawn and followed, metres, within scree_catalogue()'s limits; 0: as the quality says.
int scree_set_view_radius(float metres);
int scree_set_field_of_view(float degrees);  ///< vertical
int scree_set_look_speed(float factor);      ///< 1: a seventh of a degree for a pixel of CSS
int scree_set_particles(int on);             ///< dust of breaks, blows and merges
int scree_set_details(int on);               ///< grass, bushes and stones, where the quality has them
int scree_set_shake(int on);                 ///< blows shake the eye
int scree_set_predict(int on);               ///< own carves are shown before the server has answered
int scree_set_overlay(int on);               ///< borders, interest, bodies, contacts
int scree_set_past(int on);                  ///< the page knows a replay of this world: hints tell of it

// ---- the hand

/// The mouse, or a finger, moved by so many pixels of CSS to the right and down; adds up until the next
/// frame.
void scree_look(float right, float down);
/// What is held down now, until it is said again: right, up, forward as parts of the full speed, from −1
/// to 1. On foot any `up` above 0 is a jump. `fast`: as with Shift.
void scree_move(float right, float up, float forward, int fast);
/// The tool strikes what is in the middle of the picture; and again and again while a button or a finger is
/// held down, until it is said again.
void scree_strike();
void scree_hold(int on);
/// The wheel, notches: a larger tool, or a smaller one.
void scree_grow(float notches);
/// A key went down or up: `code` as of KeyboardEvent, "KeyW". Moves (W A S D, Space, C, Shift), and does the
/// actions of scree_catalogue(), by the native viewer's own table. 1: the key means something here, so the
/// page calls preventDefault(). Not to be called while a text is written; scree_keys_up() when the page loses
/// the keyboard.
int scree_key(const char* code, int down);
void scree_keys_up();
/// A gamepad of the standard mapping, once a frame while there is one: `axes` 4 and `buttons` 17 numbers, as
/// in Gamepad.axes and Gamepad.buttons[i].value.
void scree_gamepad(float left_x, float left_y, float right_x, float right_y, float left_trigger,
                   float right_trigger, uint32_t buttons);
/// An action by its name, as if its key had been pressed. Those that are the page's own (scree_asked()) come
/// back there.
int scree_act(const char* action);
/// Actions that keys or buttons asked for and that are the page's to do, as JSON, ["talk", "panel"]; takes
/// them. They are: figures, free_mouse, full_screen, graphs, help, hide, panel, persons, picture,
/// copy_place, talk, mute, larger_text, smaller_text, all_figures, present, and replay_play where it is no
/// replay.
const char* scree_asked();

/// The tool, by the names in scree_catalogue().
int scree_set_tool(const char* kind);  ///< its shape: "crater"
int scree_set_use(const char* use);    ///< "dig", "place", "carve", "fill", "paint"
/// To place, fill or paint with, by its name in "materials" of scree_state(). "": as the ground. A name that
/// the world's palette lacks stands for the first.
int scree_set_material(const char* name);
int scree_set_pattern(const char* name);  ///< of the cracks
int scree_set_radius(float metres);
int scree_set_blast(float metres_per_second);
int scree_set_seeds(int seeds);  ///< pieces that a carve makes; 0: by its volume

// ---- others

/// The next attempt to connect is now, and not after "retry_s".
void scree_reconnect();

/// A line to all persons. 0: it is empty, too long (limits.line_bytes_max), or there is no connection.
int scree_say(const char* text);

// ---- a game's rules

/// A message to the server's rules: a channel, 1 to 32 bytes of text, and at most
/// limits::channel_data_bytes_max bytes. 0: it is none, or there is no connection.
int scree_send(const char* channel, const uint8_t* bytes, uint32_t count);
/// Takes the next message that the rules have for this page, as scree_heard_channel() and
/// scree_heard_bytes() give it: its bytes and one; 0: there is none. After the first call, at most
/// limits::messages_heard_max wait.
uint32_t scree_heard();
const char* scree_heard_channel();
const uint8_t* scree_heard_bytes();

// ---- sound

/// What there is to hear of the last frame, for sound.wasm (sound_module.cpp): how many bytes, and then
/// where. The first call begins to listen: what pieces do is looked for from then on, without dust, too.
uint32_t scree_sounds();
const uint8_t* scree_sounds_bytes();

// ---- a replay; each does nothing where it is none, or where this person may not control it

void scree_replay_play(int on);
/// Times real time, negative: backwards.
int scree_replay_speed(float factor);
/// To that tick, or the nearest there is. Dragging may call it as often as it likes.
void scree_replay_seek(double tick);

// ---- what there is to show, as JSON

/// What never changes, once:
///
/// {"methods": [{"name", "summary", "missing": what this browser lacks for it, or null}],
///  "qualities": ["auto", "low", …], "tools": […], "uses": […], "patterns": […],
///  "limits": {"view_radius_m": [least, most], "tool_radius_m": […], "blast_speed_m_s": […], "seeds": […],
///             "field_of_view_degrees": […], "look_speed": […], "replay_speed": […],
///             "line_bytes": n, "name_bytes": n},
///  "events": [{"kind", "what"}],
///  "controls": [{"action", "key", "button", "does", "of_replay", "of_world"}]}
const char* scree_catalogue();
/// What changes, for panels, a few times a second:
///
/// {"connection": {"phase": "connecting", "connected", "lost", or "refused", which is for good,
///                 "text", "replay", "role", "session", "retry_s": until the next attempt, when lost},
///  "notice": why the last request did nothing, or news, for some seconds, or "",
///  "hint": what a newcomer may try next, or "",
///  "mark": what became of the last strike: {"number": of the answers so far, "refused": in three words, or
///  ""}, "aim": null or what a click does: {"beyond": it would be refused, "material": that it puts, or "",
///  "m3": of
///         rock that it takes or puts, or null},
///  "camera": as scree_camera(), "walks", "eye": whose eye one looks through, in words, or "",
///  "tick", "tick_rate_hz", "pace": 1 is as fast as the clock, "lost_ticks", "pieces_near", "props_near",
///  "carried": [{"name", "m3"}] in the own store, "store_m3": what it holds at most, or null, "predictions",
///  "joined": the edits around the camera have come, "loaded": and are drawn,
///  "complete": in their newest state,
///  "traffic": {"received_bytes", "sent_bytes", "received_bytes_per_s", "waiting_bytes"},
///  "mirror": null or {"frames", "pieces_made", "pieces_merged", "checks", "mismatches", "repairs",
///                     "held_chunks", "edited_bricks"},
///  "frame": {"ms": the last, from one to the next, "median_ms", "worst_ms": of the last 120,
///            "update_ms", "draw_ms": of the last, "apply_worst_ms": the longest single message,
///            "work_worst_ms": the longest job of drawing},
///  "draw": {"method", "draws", "triangles", "pieces", "kept", "waiting", "driver", "gl_errors",
///           "first_gl_error"},
///  "preparing": null or {"method", "share"},
///  "latency_ms": of one's own last request, or null,
///  "status": null or the server's last: {"clients", "pieces", "pieces_made", "pieces_merged",
///            "tick_median_ms", "tick_worst_ms", "field_hash": hexadecimal, "repairs", "chunks_waiting",
///            "saving", "ledger": {"terrain", "pieces", "dust", "poured", "moved", "stored"}, in m³,
///            "refusals": {reason: count}},
///  "materials": [{"name", "colour": "#rrggbb"}], the rows of the world's palette, which may change,
///  "tool": {"kind", "use", "material": a name, or "", "radius_m", "blast_speed_m_s", "pattern", "seeds",
///  "seeds_now"},
///  "view": {"method", "quality", "quality_auto", "view_radius_m", "particles", "details", "shake",
///           "predict", "overlay", "field_of_view_degrees", "look_speed"},
///  "persons": {"list": [{"session", "name", "role"}], "more", "chat"},
///  "lines": ["Ann: mind the edge"], of the last seconds,
///  "playback": null or {"moment", "first", "last": ticks, "speed", "playing", "grows",
///              "refusal": why this person may not control it, or "",
///              "marks": how many times scree_marks() has become another}}
const char* scree_state();
/// Other persons within the picture, every frame if wanted: [{"session", "name", "colour": "#rrggbb", "x",
/// "y" (parts of the width and height, from the upper left), "metres"}].
const char* scree_names();
/// What a game's signs show, every frame if wanted: a line of text each, of ten fields with tabs between
/// them.
/// "": nothing. Lines and bars come first, in order; then markers, the farthest first. The fields are:
///
/// - 0 (a line), 1 (a bar) or 2 (a marker); "#rrggbb"; a bar's share, 0 to 1
/// - x and y of a marker, as in scree_names(); its opacity
/// - right and down: the way from the picture's middle to a marker that lies beside the picture, else 0 and 0
/// - the name, and the words
const char* scree_signs();
/// A replay's events, counted in columns of equal time: {"first" (column 0 begins after this tick),
/// "ticks_per_column", "read_to" (up to this tick the recording has been looked through), "marks": [{"kind",
/// "column", "count"}]}.
const char* scree_marks();

}  // extern "C"
