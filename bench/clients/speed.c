/* What a client in C takes: a tick of a storm that it asks for, the mesh of a chunk, 1,000 poses. Prints three numbers,
 * microseconds of processor time. usage: speed PORT */
#include <scree/client.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { carves = 48, rounds = 200, mesh_rounds = 15, side = 4 };

static double cpu_us(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec * 1e6 + (double)now.tv_nsec / 1e3;
}

static int by_size(const void* a, const void* b) {
  return (*(const double*)a > *(const double*)b) - (*(const double*)a < *(const double*)b);
}

static double median(double* times, int count) {
  qsort(times, (size_t)count, sizeof *times, by_size);
  return times[count / 2];
}

static scree_status status_of(scree_client* client) {
  scree_status status = {.size = sizeof status};
  scree_client_status(client, &status);
  return status;
}

/* Takes what has come, and adds its time and its ticks. */
static void take(scree_client* client, double* us, uint64_t* ticks) {
  const double begun = cpu_us();
  scree_event event = {.size = sizeof event};
  scree_client_poll(client, 0);
  while (scree_client_next(client, &event) == SCREE_OK)
    if (event.kind == SCREE_EVENT_FRAME) ++*ticks;
  *us += cpu_us() - begun;
  nanosleep(&(struct timespec){0, 2000000}, NULL);
}

int main(int argc, char** argv) {
  scree_options options;
  scree_client* client = NULL;
  scree_options_init(&options, sizeof options);
  options.flags = SCREE_ONCE;
  options.eye_m[1] = 8;
  if (argc > 1) options.port = (uint32_t)strtoul(argv[1], NULL, 10);
  if (scree_client_create(&options, &client) != SCREE_OK) return 1;
  double us = 0, times[rounds];
  uint64_t ticks = 0;
  while (!status_of(client).loaded) take(client, &us, &ticks);
  us = 0;
  ticks = 0;
  for (int i = 0; i < carves; ++i) {
    scree_request carve;
    scree_request_init(&carve, sizeof carve, SCREE_CARVE);
    carve.shape.a_m[0] = carve.place_m[0] = (float)(i % 8 * 5 - 18);
    carve.shape.a_m[2] = carve.place_m[2] = (float)(i / 8 * 5 - 14);
    carve.shape.radius_m = 1.6F;
    carve.seeds = 24;
    carve.random_seed = (uint32_t)i;
    scree_client_request(client, &carve, NULL, NULL, NULL);
    for (int wait = 0; wait < 50; ++wait) take(client, &us, &ticks);
  }
  const double tick_us = us / (double)ticks;

  static scree_body bodies[8192];
  size_t count = 0;
  for (int i = 0; i < rounds; ++i) {
    const double begun = cpu_us();
    scree_client_bodies(client, -1, bodies, 8192, &count);
    times[i] = cpu_us() - begun;
  }
  const double poses_us = median(times, rounds) * 1000.0 / (double)count;

  int chunks = 0;
  for (int i = 0; i < mesh_rounds; ++i) {
    chunks = 0;
    const double begun = cpu_us();
    for (int32_t x = -side / 2; x < side / 2; ++x)
      for (int32_t z = -side / 2; z < side / 2; ++z)
        for (int32_t y = -1; y <= 0; ++y) {
          scree_mesh mesh = {.size = sizeof mesh};
          const int32_t chunk[3] = {x, y, z};
          if (scree_client_mesh_chunk(client, chunk, &mesh) != SCREE_OK) continue;
          ++chunks;
          scree_mesh_release(client, &mesh);
        }
    times[i] = cpu_us() - begun;
  }
  printf("%.1f %.1f %.2f %zu pieces, %d chunks, %llu ticks\n", tick_us, median(times, mesh_rounds) / chunks, poses_us, count, chunks,
         (unsigned long long)ticks);
  scree_client_destroy(client);
  return 0;
}
