/* Connects and disconnects COUNT times: at once, while the attempt is under way, and after the world has come, with a
 * mesher. Fails when a thread or memory is left. usage: connects PORT COUNT [KIB_MORE] */
#include <dirent.h>
#include <scree/client.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int threads(void) {
  int count = 0;
  DIR* const tasks = opendir("/proc/self/task");
  for (const struct dirent* task = readdir(tasks); task != NULL; task = readdir(tasks)) count += *task->d_name != '.';
  closedir(tasks);
  return count;
}

static long resident_kib(void) {
  char line[200];
  long kib = 0;
  FILE* const status = fopen("/proc/self/status", "r");
  while (fgets(line, sizeof line, status) != NULL)
    if (sscanf(line, "VmRSS: %ld", &kib) == 1) break;
  fclose(status);
  return kib;
}

static void connect_once(uint32_t port, int how) {
  scree_options options;
  scree_client* client = NULL;
  scree_mesher* mesher = NULL;
  scree_mesher_options meshing;
  scree_options_init(&options, sizeof options);
  options.port = port;
  options.radius_m = 32;
  options.eye_m[1] = 2;
  options.flags = SCREE_ONCE;
  if (scree_client_create(&options, &client) != SCREE_OK) exit(EXIT_FAILURE);
  if (how == 1) {
    scree_mesher_options_init(&meshing, sizeof meshing);
    meshing.radius_m = 16;
    meshing.threads = 2;
    if (scree_mesher_create(client, &meshing, &mesher) != SCREE_OK) exit(EXIT_FAILURE);
  }
  for (int i = 0; i < 1000 && how != 0; ++i) {
    scree_event event = {.size = sizeof event};
    scree_status status = {.size = sizeof status};
    scree_client_poll(client, 5);
    while (scree_client_next(client, &event) == SCREE_OK)
      if (event.kind == SCREE_EVENT_LOST) {
        fprintf(stderr, "lost: %s\n", event.text);
        exit(EXIT_FAILURE);
      }
    scree_client_status(client, &status);
    if (mesher != NULL) scree_mesher_update(mesher, options.eye_m);
    if (status.tick != 0) break;
  }
  scree_client_destroy(client);
}

int main(int argc, char** argv) {
  const uint32_t port = (uint32_t)strtoul(argv[1], NULL, 10);
  const int count = atoi(argv[2]), warm = count / 4 + 3;
  const long more = argc > 3 ? atol(argv[3]) : 2048;
  for (int i = 0; i < warm; ++i) connect_once(port, i % 3);
  const long before = resident_kib();
  for (int i = 0; i < count; ++i) connect_once(port, i % 3);
  const long after = resident_kib();
  printf("%d connects: %d thread, %ld KiB before, %ld KiB after\n", count, threads(), before, after);
  return threads() == 1 && after - before <= more ? EXIT_SUCCESS : EXIT_FAILURE;
}
