// Joins a server of Scree and carves a hole below its eye. usage: mono carve.exe [HOST [PORT]]
using System;
using Scree;

static class Carve {
  static int Main(string[] args) {
    var host = args.Length > 0 ? args[0] : "127.0.0.1";
    var port = args.Length > 1 ? uint.Parse(args[1]) : 4177;
    using (var client = new Client(host, port, Flag.Once)) {
      bool asked = false, answered = false;
      while (!answered) {
        Event told;
        client.Poll(100);
        while (client.Next(out told)) {
          if (told.Kind == EventKind.Lost) {
            Console.Error.WriteLine("lost: " + told.Text);
            return 1;
          }
          if (told.Kind != EventKind.Reply) continue;
          Console.WriteLine(told.Text == "" ? told.Number + " pieces" : "refused: " + told.Text);
          answered = true;
        }
        var status = client.Status();
        if (asked || status.Loaded == 0) continue;
        var above = new Vec3(status.Eye.X, status.Eye.Y + 50, status.Eye.Z);
        var hit = client.Cast(above, new Vec3(0, -1, 0), 200);
        if (hit == null) continue;
        var carve = Client.Make(RequestKind.Carve);
        carve.Shape.Radius = 2;
        Console.WriteLine("carves " + client.Material(hit.Value.Material).Value.Name);
        carve.Shape.A = carve.Place = hit.Value.Place;
        client.Ask(carve);
        asked = true;
      }
    }
    return 0;
  }
}
