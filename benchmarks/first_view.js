// What the page under measurement notes: when each live request left and its answer was there, when a canvas was
// cleared to be drawn anew, each frame, and tasks of 50 ms or more.
window.seen = {sent: [], answered: [], drawn: [], moved: [], frames: []};
window.tasks = [];
new PerformanceObserver((list) => tasks.push(...list.getEntries())).observe({type: "longtask"});

const fetched = window.fetch;
window.fetch = async (address, options) => {
  if (!String(address?.url ?? address).includes("/api/v1/live")) return fetched(address, options);
  const index = seen.sent.push(performance.now()) - 1;
  const answer = await fetched(address, options);
  seen.answered[index] = performance.now();
  return answer;
};

const {clearRect} = CanvasRenderingContext2D.prototype;
CanvasRenderingContext2D.prototype.clearRect = function (...area) {
  seen.drawn.push(performance.now());
  return clearRect.apply(this, area);
};

// The size of all that had come by the time the first curves stood, answers' heads included, and that time [kB, ms].
window.firstCurves = () => {
  const [drawn] = seen.drawn;
  const come = [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")].filter(
    ({responseEnd}) => responseEnd > 0 && responseEnd <= drawn,
  );
  return [come.reduce((sum, {transferSize}) => sum + transferSize, 0) / 1000, drawn];
};

// From now on moves of the pointer and frames are noted.
window.watchMoves = () => {
  document.addEventListener("pointermove", ({timeStamp}) => seen.moved.push(timeStamp), {capture: true});
  const frame = (now) => requestAnimationFrame(frame, seen.frames.push(now));
  requestAnimationFrame(frame);
};

// The longest of the tasks that ended after a sweep's rows had come [ms].
window.longestTask = () => {
  const [{responseEnd}] = performance.getEntriesByType("resource").filter(({name}) => name.includes("/table?"));
  const after = tasks.filter(({startTime, duration}) => startTime + duration > responseEnd);
  return Math.max(0, ...after.map(({duration}) => duration));
};
