// A client of Scree, a server of destructible terrain. Lengths are metres and y points up; rotations are unit quaternions
// (x, y, z, w); triples of integers that name a voxel, a brick (8 voxels a side) or a chunk (32 voxels a side) count from
// the world's origin. Colours are linear.

/** Three numbers: an array, a typed array, or an object such as three.js' Vector3. */
export type Triple = ArrayLike<number> | { x: number; y: number; z: number };
export type Quaternion = ArrayLike<number> | { x: number; y: number; z: number; w: number };

/**
 * What a call, a request or a connection failed with. `name` is for programs: the server's name of a refusal
 * (docs/protocol.md), or "invalid", "not_connected", "no_memory", "too_small", "refused", "connection_lost", "closed",
 * "too_slow", "failed". `message` is for people.
 */
export class ScreeError extends Error {
  constructor(name: string, message?: string);
}

export interface ConnectOptions {
  /** The person's name, shown to others. */
  name?: string;
  /** The program's name, for the server's log; "scree-client.js" by default. */
  program?: string;
  /** An access token. It goes to other machines by wss: alone, unless `insecureToken` is set. */
  token?: string;
  insecureToken?: boolean;
  /** The middle of what the client follows, metres; by default the server's place for visitors. */
  eye?: Triple;
  /** How far it follows, metres; 96 by default. The server may grant less. */
  radius?: number;
  /** Requests show their probable result before the server answers. */
  predict?: boolean;
  /** Messages wait a little for their moment, so that motions are even: for drawing, with drawTick(). */
  smooth?: boolean;
  /** Tells where pieces became terrain, those from before among them (events "stone"). */
  stones?: boolean;
  /** It is a person's: hears lines and learns who is there. */
  meets?: boolean;
  /** Blows of at least so many joules are told (events "contact"). */
  contacts?: number;
  /** A lost connection is not tried again. */
  once?: boolean;
  /** What an attempt may take, milliseconds; 10,000 by default. */
  connectMilliseconds?: number;
  /** Bytes of edits that are kept for the next connection of this client; 16 MiB by default. */
  cacheBytes?: number;
  /** scree_client.wasm: compiled, as bytes, or where it is; by default the package's own, beside its scripts. */
  wasm?: WebAssembly.Module | BufferSource | string | URL;
  /** The class of sockets; by default the global one, or under Node without one that of the package ws. */
  WebSocket?: unknown;
}

/**
 * Joins the server at "ws://HOST:PORT" or "wss://HOST:PORT". Rejects when the first attempt fails. A connection that is
 * lost later is tried again, unless the server's refusal stays.
 */
export function connect(address: string, options?: ConnectOptions): Promise<Client>;

// ---- requests

export interface Sphere { shape?: 'sphere'; centre: Triple; /** metres */ radius: number }
/** Rough rock within a ball, as a blast leaves it. */
export interface Crater { shape: 'crater'; centre: Triple; /** metres */ radius: number }
export interface Box { shape: 'box'; centre: Triple; /** half of its sides, metres */ half: Triple; /** of its edges, metres */ radius?: number }
export interface Capsule { shape: 'capsule'; from: Triple; to: Triple; /** metres */ radius: number }
export type Shape = Sphere | Crater | Box | Capsule;

/** A row of the palette: its number, or its name. */
export type MaterialChoice = number | string;

export type Carve = Shape & {
  /** How seeds of the pieces lie: "natural", "radial" and so on. */
  pattern?: string;
  /** Pieces, about; 32 by default. */
  seeds?: number;
  randomSeed?: number;
  /** The place of the blow, metres; the middle of the shape by default. */
  impact?: Triple;
  /** Of the pieces, metres a second; 6 by default. */
  speed?: number;
  /** The piece that is carved; the terrain by default. */
  piece?: number;
};
export type Fill = Shape & { /** as the ground around by default */ material?: MaterialChoice };
export type Paint = Shape & { material: MaterialChoice };
export interface Blast { centre: Triple; /** joules; 4.2e6 by default */ energy?: number; randomSeed?: number }
export type Dig = Shape | { piece: number };
export type Place = Shape & { material: MaterialChoice; /** else as rubble */ solid?: boolean };
export interface BreakPiece { piece: number; at: Triple; /** 8 by default */ seeds?: number; randomSeed?: number }
export interface Push { body: number; at: Triple; /** newton seconds */ impulse: Triple }
export type AddBody = ({ shape?: 'sphere'; radius: number } | { shape: 'box'; half: Triple }) & {
  position: Triple;
  rotation?: Quaternion;
  /** metres a second */
  velocity?: Triple;
  /** kilograms; by its material by default */
  mass?: number;
  material?: MaterialChoice;
  motion?: 'dynamic' | 'kinematic' | 'fixed';
  /** The game's own. */
  tag?: number;
};
export interface MoveBody { body: number; position: Triple; rotation?: Quaternion; /** metres a second */ velocity?: Triple }

export interface Reply {
  kind: 'reply';
  /** The request's number on this connection. */
  request: number;
  tick: number;
  /** Pieces that were made, or units of mass (1/254 of a voxel) that were dug, placed or painted. */
  count: number;
  /** The body that was added, else 0. */
  id: number;
  /** Of events alone: a promise rejects with it. */
  error: ScreeError | null;
}

// ---- events

export type Vector = [number, number, number];
export type Event =
  /** Again after a lost connection: forget all meshes, pieces and bodies. Meshers begin anew by themselves. */
  | { kind: 'joined'; session: number; tick: number; otherWorld: boolean; recording: boolean }
  /** `final`: it is not tried again. */
  | { kind: 'lost'; reason: string; refusal: string; final: boolean }
  /** The copy is as of the tick. */
  | { kind: 'frame'; tick: number }
  /** Triples of bricks that changed. */
  | { kind: 'terrain'; tick: number; bricks: Int32Array }
  | { kind: 'pieceAdded'; id: number }
  /** It became terrain, or is out of sight. */
  | { kind: 'pieceRemoved'; id: number }
  | { kind: 'bodyAdded'; id: number }
  | { kind: 'bodyRemoved'; id: number }
  /** A piece became terrain where it lies. */
  | { kind: 'stone'; id: number; position: Vector; rotation: [number, number, number, number] }
  | Reply
  /** Once a second: status() is new. */
  | { kind: 'status' }
  /** material() has other answers. */
  | { kind: 'palette' }
  /** A line of a person, or of the server (session 0). */
  | { kind: 'said'; session: number; name: string; text: string }
  /** `first`: of all that there are now. */
  | { kind: 'person'; session: number; name: string; role: number; first: boolean }
  /** Of the game's rules. */
  | { kind: 'message'; channel: string; bytes: Uint8Array }
  /** `first`: of all that there are now; an empty name: there is none. `share`: of a bar, 0 to 1. */
  | { kind: 'sign'; name: string; text: string; position: Vector; form: 'line' | 'bar' | 'marker'; share: number; first: boolean }
  /** What sounds or is seen; joules. */
  | { kind: 'cue'; tick: number; name: string; position: Vector; energy: number }
  /** A blow between a body and another one, or the terrain (0); joules. */
  | { kind: 'contact'; tick: number; id: number; other: number; position: Vector; energy: number };

// ---- the copy of the world

export interface Status {
  connected: boolean;
  session: number;
  /** The copy is as of it. */
  tick: number;
  /** Ticks a second. */
  tickRate: number;
  /** 0 looks, 1 carves, 2 builds, 4 directs, 3 administers: in order of power. */
  role: number;
  /** A voxel's side, metres. */
  voxel: number;
  /** As granted, metres. */
  radius: number;
  /** The middle of what is followed. */
  eye: Vector;
  /** The edits around seem to have arrived. */
  loaded: boolean;
  pieces: number;
  bodies: number;
  /** Requests that are shown and not answered. */
  predictions: number;
  onFoot: boolean;
  feet: Vector;
  heldChunks: number;
  editedBricks: number;
  /** Of all edits that are here: the server's own, when all of its edits are. */
  fieldHash: bigint;
  /** Of the server's last status; 0: none has come. All below are of it. */
  serverTick: number;
  serverHash: bigint;
  /** In units of mass: 1/254 of a voxel. */
  ledgerTerrain: number;
  ledgerPieces: number;
  ledgerDust: number;
  ledgerPoured: number;
  ledgerStored: number;
  receivedBytes: number;
  sentBytes: number;
  /** Frames whose check failed; their chunks were asked for again. */
  mismatches: number;
  /** Where who begins looks, a unit vector; 0: the server does not say. */
  spawnLook: Vector;
}

/** Columns, ordered by kind, then id. */
export interface Bodies {
  count: number;
  /** 0: a piece; 1: a prop; 2: the body of a person. */
  kinds: Uint8Array;
  ids: Uint32Array;
  /** 3 a body, metres. */
  positions: Float32Array;
  /** 4 a body: x, y, z, w. */
  rotations: Float32Array;
}

export interface Material {
  /** Linear, 0 to 1. */
  colour: Vector;
  roughness: number;
  /** kg/m³ */
  density: number;
  friction: number;
  name: string;
}

/** A prop, as who added it made it, or the body of a person. */
export interface Prop {
  motion: 'dynamic' | 'kinematic' | 'fixed';
  material: number;
  /** kilograms; 0: by its material */
  mass: number;
  /** The game's own, as is the data. */
  tag: number;
  /** Of the person whose body it is; 0: nobody's. */
  session: number;
  data: Uint8Array | null;
}

/** What questions about space are about; all by default. */
export type Mask = ('terrain' | 'pieces' | 'bodies')[];

export interface Hit {
  kind: 'terrain' | 'piece' | 'body';
  /** Of a piece or a body. */
  id: number;
  /** Of terrain and pieces. */
  material: number;
  /** metres */
  distance: number;
  place: Vector;
  normal: Vector;
  /** The cast began within it. */
  inside: boolean;
  /** False: ground on the way has not arrived. */
  exact: boolean;
}

/** Triangles, counter-clockwise seen from the air. All arrays are the program's own. */
export interface Mesh {
  kind: 'terrain' | 'piece' | 'prop';
  /** Of a piece. */
  id: number;
  /** Of terrain: a cell has 2^level voxels a side. */
  level: number;
  /** Of terrain: which block of 16 cells a side of that level; of meshChunk(): the chunk. */
  node: Vector;
  /** Of terrain: where the positions begin, metres. A piece's are about its centre of mass, which its pose places. */
  origin: Vector;
  /** It is to be removed, and nothing takes its place. */
  gone: boolean;
  /** 3 a vertex, metres. */
  positions: Float32Array;
  /** 3 a vertex, unit. */
  normals: Float32Array;
  /** 1 a vertex: row of the palette. */
  materials: Uint8Array;
  /** 1 a vertex: 255 under the open sky, less in a crevice. */
  shades: Uint8Array;
  /** 3 a triangle. */
  indices: Uint32Array;
}

export interface Mesher {
  /**
   * Meshes terrain around the eye, and pieces, for about so many milliseconds (4 by default). Show all of what it returns
   * at once: each mesh replaces the one of the same level and node, or of the same piece. Call it once a frame.
   */
  update(eye: Triple, milliseconds?: number): Mesh[];
  /** All is meshed in its newest state. */
  readonly complete: boolean;
  close(): void;
}

/** One thread uses a client. Calls that fail throw a ScreeError; requests reject with one. */
export class Client {
  private constructor();
  /** Of the package. */
  readonly version: string;
  /** Of the protocol that it speaks. */
  readonly protocol: number;

  /**
   * The events from this call on, for `for await`. It ends when the client is closed, and throws when the connection is
   * lost for good. One that falls 100,000 events behind throws "too_slow".
   */
  events(): AsyncIterableIterator<Event>;

  /** Resolves when the palette and the edits around seem to have arrived. */
  loaded(): Promise<void>;

  carve(carve: Carve): Promise<Reply>;
  fill(fill: Fill): Promise<Reply>;
  paint(paint: Paint): Promise<Reply>;
  blast(blast: Blast): Promise<Reply>;
  /** Goes into the own store. */
  dig(dig: Dig): Promise<Reply>;
  /** Out of the own store. */
  place(place: Place): Promise<Reply>;
  /** The shape becomes a piece that never merges until it is released. */
  cutOut(shape: Shape): Promise<Reply>;
  release(given: { piece: number }): Promise<Reply>;
  breakPiece(given: BreakPiece): Promise<Reply>;
  push(push: Push): Promise<Reply>;
  /** Takes the role that directs. */
  addBody(body: AddBody): Promise<Reply>;
  removeBody(given: { body: number }): Promise<Reply>;
  moveBody(move: MoveBody): Promise<Reply>;
  /** Enters the world on foot, or leaves it. */
  stand(given?: { leave?: boolean }): Promise<Reply>;
  /** All of the own store goes to the world's. */
  give(): Promise<Reply>;

  /** Moves the middle of what the client follows, and how far it follows. */
  follow(eye: Triple, radius: number): void;
  /** A line to all persons. */
  say(text: string): void;
  /** Bytes, or a text, for the game's rules. */
  send(channel: string, data: string | ArrayBuffer | ArrayBufferView): void;
  /**
   * One tick on foot, after stand(): a way along x and z of length 1 at most. Call it once for each tick of the server's.
   * False: the person is not on foot, or the server has not taken what it was sent.
   */
  walk(step: { way?: [number, number]; jump?: boolean; run?: boolean; look?: Triple }): boolean;

  status(): Status;
  /** A prop by its id; null: there is none. */
  prop(id: number): Prop | null;
  /** A row of the palette; null beyond the last one. */
  material(number: number): Material | null;
  findMaterial(name: string): number;
  /** Units of mass of a material in the own store. */
  carried(material: MaterialChoice): number;
  /** Poses at a tick and its fraction; below 0, and by default, the newest ones. `into`: what an earlier call has given; it
   *  becomes the answer. Whoever asks every frame saves the time for new arrays, which is most of it. */
  bodies(tick?: number, into?: Bodies | null): Bodies;
  /** The tick, with its fraction, at which to draw now; for a client with `smooth`. */
  drawTick(): number;

  /** What a ray along the direction, or a ball of that radius, hits within `most` metres (100 by default); null: nothing. */
  cast(from: Triple, direction: Triple, options?: { most?: number; radius?: number; of?: Mask }): Hit | null;
  /** The nearest surface within `most` metres, 8 at most and by default; null: none is so near. */
  nearest(place: Triple, options?: { most?: number; of?: Mask }): Hit | null;
  /** What is in a ball. */
  overlap(place: Triple, radius: number, options?: { of?: Mask }): { terrain: boolean; ids: Uint32Array };
  /** Signed distances of places (3 numbers each) to the terrain, metres, below 0 in rock; beyond three voxels, that. */
  distances(places: ArrayLike<number>): Float32Array;
  /** Codes of the voxels of a box (`lo` in it, `hi` not), z fastest: -127 to 127, in 1/42 voxel, below 0 in rock. */
  codes(lo: Triple, hi: Triple): Int8Array;

  /**
   * `radius`: twice that of the finest detail, metres; 128 by default. Coarser levels reach eight times as far. `rounded`:
   * edges are left round.
   */
  mesher(options?: { radius?: number; method?: 'nets' | 'dual' | 'cubes'; rounded?: boolean }): Mesher;
  /** The mesh of one chunk by surface nets, at the level of voxels; null: it has no surface. */
  meshChunk(chunk: Triple): Mesh | null;
  /** The mesh of one piece, or of a prop's form, in its own axes; null: there is none. */
  meshBody(id: number): Mesh | null;

  /** Says goodbye. Resolves when the socket is closed; nothing of the client keeps a program running then. */
  close(): Promise<void>;
}
