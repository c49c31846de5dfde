# cmake -DTOOL=... -DFLAG=... -DOUTPUT=... -P PrintToFile.cmake: what `TOOL FLAG` prints becomes the file OUTPUT.
execute_process(COMMAND ${TOOL} ${FLAG} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${OUTPUT} "${text}")
