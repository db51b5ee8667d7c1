/* Runs the exported block step by step as Simulink would, asking for outputs twice; writes status and input of every step. */
#include "controller_sfun.c"
#include <stdio.h>
int main(int argc, char **argv)
{
    const size_t n = (size_t)atoi(argv[1]), length = (size_t)atoi(argv[6]);
    const size_t steps = argc > 7 ? (size_t)atoi(argv[7]) : 0;
    FILE *in = fopen("looks", "rb"), *out = fopen("simulink", "wb");
    SimStruct block = {0}, *S = &block;
    double x[64], u[64], status;
    size_t step, width;
    int j;
    block.parameter = 0.5;
    mdlInitializeSizes(S);
    mdlInitializeSampleTimes(S);
    if (block.period != 0.5 || block.input_width != (int)n || block.outputs != 2 || block.sample_times != 1 ||
        block.contiguous != 1 || block.feedthrough != 1) {
        return 2;
    }
    width = (size_t)(atoi(argv[2]) / GROUP_STEPS);
    block.input = x;
    block.output[0] = u;
    block.output[1] = &status;
    for (j = 0; j < block.vectors; ++j) {
        block.work[j] = calloc((size_t)block.width[j], block.type[j] == SS_DOUBLE ? 8 : 4);
    }
    for (step = 0; step < steps; ++step) {
        uint32_t said;
        if (fread(x, sizeof(double), n, in) != n) {
            return 1;
        }
        if (step % length == 0) {
            mdlInitializeConditions(S);
        }
        mdlOutputs(S, 0);
        mdlOutputs(S, 0);
        mdlUpdate(S, 0);
        said = (uint32_t)status;
        if (fwrite(&said, 4, 1, out) != 1 || fwrite(u, sizeof(double), width, out) != width) {
            return 1;
        }
    }
    mdlTerminate(S);
    return fclose(out);
}
