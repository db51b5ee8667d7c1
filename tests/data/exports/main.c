/* Answers with the C code: round by round, reads the states and steps of all runs, writes statuses and inputs. */
#include "controller.c"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
int main(int argc, char **argv)
{
    const size_t n = (size_t)atoi(argv[1]), width = (size_t)atoi(argv[2]), runs = (size_t)atoi(argv[3]);
    const int rounds = argc > 4 ? atoi(argv[4]) : 0;
    FILE *in = fopen("looks", "rb"), *out = fopen("c", "wb");
    double *x = malloc(sizeof(double) * n * runs), *u = malloc(sizeof(double) * (width + 1) * runs);
    uint32_t *k = malloc(4 * runs), *status = malloc(4 * runs), *memories = malloc(4 * runs);
    int round;
    size_t i;
    for (round = 0; round < rounds; ++round) {
        if (fread(x, sizeof(double), n * runs, in) != n * runs || fread(k, 4, runs, in) != runs) {
            return 1;
        }
        for (i = 0; i < runs; ++i) {
            double one[64] = {0};
            uint32_t memory = memories[i];
#ifdef PREFIX_START
            if (round == 0) {
                memory = PREFIX_START;
            }
#endif
            status[i] = prefix_control(x + n * i, k[i], MEMORY, (void *)one);
            memories[i] = memory;
            memcpy(u + width * i, one, sizeof(double) * width);
        }
        if (fwrite(status, 4, runs, out) != runs || fwrite(u, sizeof(double), width * runs, out) != width * runs) {
            return 1;
        }
    }
    return fclose(out);
}
