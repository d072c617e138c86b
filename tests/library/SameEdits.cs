// As same_edits.c. usage: mono same_edits.exe PORT LIST FIRST STEP GO
using System;
using System.Globalization;
using System.IO;
using Scree;

static class SameEdits {
  const int atRest = 4;
  const uint waitMs = 50;
  static bool replied;
  static int quiet;
  static ulong hash;

  static void Poll(Client client) {
    Event told;
    client.Poll(waitMs);
    while (client.Next(out told)) {
      if (told.Kind == EventKind.Lost) throw new ScreeException("lost: " + told.Text);
      if (told.Kind == EventKind.Reply) {
        if (told.Text != "") throw new ScreeException("refused: " + told.Text);
        replied = true;
      }
      if (told.Kind != EventKind.Status) continue;
      var status = client.Status();
      var same = status.Pieces == 0 && status.ServerHash == hash && status.FieldHash == hash;
      quiet = same ? quiet + 1 : 0;
      hash = status.ServerHash;
    }
  }

  static Request ReadEdit(Client client, string line) {
    var words = line.Split(' ');
    Func<int, float> number = i => float.Parse(words[i], CultureInfo.InvariantCulture);
    var kind = words[0] == "carve" ? RequestKind.Carve : words[0] == "fill" ? RequestKind.Fill : RequestKind.Paint;
    var request = Client.Make(kind);
    request.Place = request.Shape.A = new Vec3(number(2), number(3), number(4));
    if (words[1] == "box") {
      request.Shape.Kind = ShapeKind.Box;
      request.Shape.B = new Vec3(number(5), number(6), number(7));
    } else {
      request.Shape.Radius = number(5);
    }
    if (kind == RequestKind.Carve) {
      request.Seeds = uint.Parse(words[6]);
      request.RandomSeed = uint.Parse(words[7]);
    }
    if (kind == RequestKind.Paint) request.Material = client.FindMaterial(words[6]).Value;
    return request;
  }

  static void Main(string[] args) {
    int first = int.Parse(args[2]), step = int.Parse(args[3]), i = 0;
    using (var client = new Client("127.0.0.1", uint.Parse(args[0]), Flag.Once)) {
      while (client.Status().Loaded == 0 || client.FindMaterial("timber") == null) Poll(client);
      foreach (var line in File.ReadLines(args[1])) {
        if (line.StartsWith("#") || i++ % step != first) continue;
        replied = false;
        client.Ask(ReadEdit(client, line));
        while (!replied) Poll(client);
      }
      Console.WriteLine("done");
      while (!File.Exists(args[4])) Poll(client);
      for (quiet = 0; quiet < atRest;) Poll(client);
      Console.WriteLine(hash.ToString("x16"));
    }
  }
}
