# Takes what names the machine's owner and folders out of a benchmark's JSON file: cmake -DFILE=... -P anonymise.cmake
file(READ ${FILE} json)
foreach(name host_name executable)
  string(JSON json REMOVE "${json}" context ${name})
endforeach()
file(WRITE ${FILE} "${json}\n")
