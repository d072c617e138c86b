// scree/client.h for C#: the structs and functions that most programs need, by P/Invoke. Names are the header's.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Scree {

[Flags]
public enum Flag : uint { Tls = 1, InsecureToken = 2, AtSpawn = 4, Predict = 8, Smooth = 16, Stones = 32, Once = 64, Meets = 128 }
public enum EventKind : uint {
  Joined = 1, Lost, Frame, Terrain, PieceAdded, PieceRemoved, BodyAdded, BodyRemoved, Stone, Reply, Status, Palette, Said,
  Person, Message, Sign, Cue, Contact
}
public enum RequestKind : uint {
  Carve = 1, Fill, Paint, Blast, Dig, Place, CutOut, Release, Break, Push, AddBody, RemoveBody, MoveBody, Stand, Give
}
public enum ShapeKind : uint { Sphere, Box, Capsule, Crater }

[StructLayout(LayoutKind.Sequential)]
public struct Vec3 {
  public float X, Y, Z;
  public Vec3(float x, float y, float z) { X = x; Y = y; Z = z; }
}
[StructLayout(LayoutKind.Sequential)]
public struct Turn { public float X, Y, Z, W; }

[StructLayout(LayoutKind.Sequential)]
public struct Options {
  public uint Size;
  public Flag Flags;
  public IntPtr Host;
  public uint Port, ConnectMs;
  public IntPtr CaFile, Fingerprint, Token, Name, Program;
  public Vec3 Eye;
  public float Radius;
  public IntPtr CacheFolder;
  public ulong CacheBytes;
  public float ContactsJ;
  public IntPtr User, Allocate, Release;
}

[StructLayout(LayoutKind.Sequential)]
public struct Event {
  public uint Size;
  public EventKind Kind;
  public uint Flags, Request;
  public ulong Tick, Session;
  public long Number;
  public uint Id;
  public float Value;
  public Vec3 Position;
  public Turn Rotation;
  public IntPtr NameBytes, TextBytes, Data;
  public UIntPtr DataBytes;
  public IntPtr Coords;
  public UIntPtr CoordCount;
  public string Name { get { return Utf8.Read(NameBytes); } }
  public string Text { get { return Utf8.Read(TextBytes); } }
}

// Texts that end with 0.
static class Utf8 {
  public static string Read(IntPtr from) {
    if (from == IntPtr.Zero) return null;
    var count = 0;
    while (Marshal.ReadByte(from, count) != 0) ++count;
    var bytes = new byte[count];
    Marshal.Copy(from, bytes, 0, count);
    return Encoding.UTF8.GetString(bytes);
  }
  public static byte[] Write(string text) { return Encoding.UTF8.GetBytes(text + "\0"); }
  // To be freed by Marshal.FreeHGlobal(); null stays null.
  public static IntPtr Copy(string text) {
    if (text == null) return IntPtr.Zero;
    var bytes = Write(text);
    var copy = Marshal.AllocHGlobal(bytes.Length);
    Marshal.Copy(bytes, 0, copy, bytes.Length);
    return copy;
  }
}

[StructLayout(LayoutKind.Sequential)]
public struct Body {
  public uint Id, Kind;
  public Vec3 Position;
  public Turn Rotation;
}

[StructLayout(LayoutKind.Sequential)]
public struct Material {
  public uint Size;
  public Vec3 Colour;
  public float Roughness, Density, Friction;
  public IntPtr NameBytes;
  public string Name { get { return Utf8.Read(NameBytes); } }
}

[StructLayout(LayoutKind.Sequential)]
public struct Shape {
  public ShapeKind Kind;
  public Vec3 A, B;
  public float Radius;
}

[StructLayout(LayoutKind.Sequential)]
public struct Request {
  public uint Size;
  public RequestKind Kind;
  public uint Flags, Material;
  public Shape Shape;
  public uint Pattern, Seeds, RandomSeed, Body;
  public Vec3 Place;
  public Turn Rotation;
  public Vec3 Vector;
  public float Speed, Energy, Mass;
  public uint Motion;
  public ulong Tag;
}

[StructLayout(LayoutKind.Sequential)]
public struct Status {
  public uint Size, Connected;
  public ulong Session, Tick;
  public uint TickRate, Role;
  public float Voxel, Radius;
  public Vec3 Eye;
  public uint Loaded, Pieces, Bodies, Predictions, OnFoot;
  public Vec3 Feet;
  public uint HeldChunks;
  public ulong EditedBricks, FieldHash, ServerTick, ServerHash;
  public long Terrain, PiecesMass, Dust, Poured, Stored;
  public ulong ReceivedBytes, SentBytes, Mismatches;
  public Vec3 SpawnLook;
}

[StructLayout(LayoutKind.Sequential)]
public struct Hit {
  public uint Size, Kind, Id, Material;
  public float Distance;
  public Vec3 Place, Normal;
  public uint Inside, Exact;
}

// Bad arguments, and what the library cannot do, in its words.
public class ScreeException : Exception {
  public ScreeException(string words) : base(words) {}
}

// A client of a server. One thread at a time uses it.
public sealed class Client : IDisposable {
  const string library = "scree_client";
  const int tooSmall = -4;
  [DllImport(library)] static extern IntPtr scree_error();
  [DllImport(library)] static extern int scree_options_init(out Options options, uint size);
  [DllImport(library)] static extern int scree_client_create(ref Options options, out IntPtr client);
  [DllImport(library)] static extern void scree_client_destroy(IntPtr client);
  [DllImport(library)] static extern int scree_client_poll(IntPtr client, uint wait);
  [DllImport(library)] static extern int scree_client_next(IntPtr client, ref Event told);
  [DllImport(library)] static extern int scree_request_init(out Request request, uint size, RequestKind kind);
  [DllImport(library)] static extern int scree_client_request(IntPtr client, ref Request request, IntPtr reply, IntPtr user, out uint number);
  [DllImport(library)] static extern int scree_client_status(IntPtr client, ref Status status);
  [DllImport(library)] static extern int scree_client_follow(IntPtr client, ref Vec3 eye, float radius);
  [DllImport(library)] static extern int scree_client_cast(IntPtr client, ref Vec3 from, ref Vec3 unit, float most, float radius, uint mask, ref Hit hit);
  [DllImport(library)] static extern int scree_client_find_material(IntPtr client, byte[] name, out uint number);
  [DllImport(library)] static extern int scree_client_material(IntPtr client, uint number, ref Material material);
  [DllImport(library)] static extern int scree_client_bodies(IntPtr client, double tick, [Out] Body[] bodies, UIntPtr room, out UIntPtr count);
  [DllImport(library)] static extern int scree_client_say(IntPtr client, byte[] text);

  IntPtr handle;

  static int Check(int result) {
    if (result < 0) throw new ScreeException(Utf8.Read(scree_error()));
    return result;
  }
  static uint SizeOf<T>() { return (uint)Marshal.SizeOf(typeof(T)); }

  // A name and Flag.Meets make it a person's. The radius is what it follows, metres.
  public Client(string host, uint port, Flag flags, string name = null, string token = null, float radius = 96) {
    Options options;
    Check(scree_options_init(out options, SizeOf<Options>()));
    options.Host = Utf8.Copy(host);
    options.Name = Utf8.Copy(name);
    options.Token = Utf8.Copy(token);
    options.Port = port;
    options.Radius = radius;
    options.Flags |= flags;
    try {
      Check(scree_client_create(ref options, out handle));
    } finally {
      Marshal.FreeHGlobal(options.Host);
      Marshal.FreeHGlobal(options.Name);
      Marshal.FreeHGlobal(options.Token);
    }
  }
  public void Dispose() {
    scree_client_destroy(handle);
    handle = IntPtr.Zero;
  }
  public void Poll(uint waitMs) { Check(scree_client_poll(handle, waitMs)); }
  // False: no event is left until the next Poll().
  public bool Next(out Event told) {
    told = new Event { Size = SizeOf<Event>() };
    return Check(scree_client_next(handle, ref told)) == 0;
  }
  public static Request Make(RequestKind kind) {
    Request request;
    Check(scree_request_init(out request, SizeOf<Request>(), kind));
    return request;
  }
  // The number that the reply will have.
  public uint Ask(Request request) {
    uint number;
    Check(scree_client_request(handle, ref request, IntPtr.Zero, IntPtr.Zero, out number));
    return number;
  }
  public Status Status() {
    var status = new Status { Size = SizeOf<Status>() };
    Check(scree_client_status(handle, ref status));
    return status;
  }
  public void Follow(Vec3 eye, float radius) { Check(scree_client_follow(handle, ref eye, radius)); }
  // Where a ray hits, of terrain (1), pieces (2) and bodies (4); null: nowhere.
  public Hit? Cast(Vec3 from, Vec3 unit, float most, uint mask = 7) {
    var hit = new Hit { Size = SizeOf<Hit>() };
    return Check(scree_client_cast(handle, ref from, ref unit, most, 0, mask, ref hit)) == 0 ? hit : (Hit?)null;
  }
  public uint? FindMaterial(string name) {
    uint number;
    return Check(scree_client_find_material(handle, Utf8.Write(name), out number)) == 0 ? number : (uint?)null;
  }
  // Null: the palette has no such row.
  public Material? Material(uint number) {
    var material = new Material { Size = SizeOf<Material>() };
    return Check(scree_client_material(handle, number, ref material)) == 0 ? material : (Material?)null;
  }
  // The newest poses of pieces (0), props (1) and persons (2), by kind and id.
  public Body[] Bodies() {
    UIntPtr count;
    var bodies = new Body[0];
    while (scree_client_bodies(handle, -1, bodies, (UIntPtr)bodies.Length, out count) == tooSmall) bodies = new Body[(int)count];
    Array.Resize(ref bodies, (int)count);
    return bodies;
  }
  public void Say(string text) { Check(scree_client_say(handle, Utf8.Write(text))); }
}

}
