/* As much of Simulink's interface as the exported block uses, to run it without Simulink. */
#ifndef SIMSTRUC_H
#define SIMSTRUC_H
#include <stdint.h>
#include <stdlib.h>

typedef int int_T;
typedef struct {
    int parameters, inputs, outputs, vectors, sample_times, contiguous, feedthrough;
    int input_width, output_width[2], width[8], type[8];
    double parameter, period, offset;
    double *input, *output[2];
    void *work[8];
} SimStruct;

enum { SS_DOUBLE = 0, SS_UINT32 = 7 };
enum { SS_OPTION_EXCEPTION_FREE_CODE = 1 };

#define ssSetNumSFcnParams(S, count) ((S)->parameters = (count))
#define ssGetNumSFcnParams(S) ((S)->parameters)
#define ssGetSFcnParamsCount(S) 1
#define ssSetSFcnParamTunable(S, i, yes) ((void)(S), (void)(i), (void)(yes))
#define ssGetSFcnParam(S, i) (&(S)->parameter + (i))
#define mxGetScalar(parameter) (*(parameter))
#define ssSetNumInputPorts(S, count) ((S)->inputs = (count))
#define ssSetNumOutputPorts(S, count) ((S)->outputs = (count))
#define ssSetInputPortWidth(S, i, count) ((S)->input_width = (count))
#define ssSetInputPortRequiredContiguous(S, i, yes) ((S)->contiguous = (yes))
#define ssSetInputPortDirectFeedThrough(S, i, yes) ((S)->feedthrough = (yes))
#define ssSetOutputPortWidth(S, i, count) ((S)->output_width[i] = (count))
#define ssSetNumSampleTimes(S, count) ((S)->sample_times = (count))
#define ssSetSampleTime(S, i, time) ((S)->period = (time))
#define ssSetOffsetTime(S, i, time) ((S)->offset = (time))
#define ssSetNumDWork(S, count) ((S)->vectors = (count))
#define ssSetDWorkWidth(S, i, count) ((S)->width[i] = (count))
#define ssSetDWorkDataType(S, i, kind) ((S)->type[i] = (kind))
#define ssSetOptions(S, options) ((void)(S), (void)(options))
#define ssGetDWork(S, i) ((S)->work[i])
#define ssGetInputPortSignal(S, i) ((const void *)(S)->input)
#define ssGetOutputPortRealSignal(S, i) ((S)->output[i])
#endif
