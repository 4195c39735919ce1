// What a page asks the server to do. The field says that the page itself asks: no form of another site can send it.
export const order = (path, body, how = {}) => fetch(path, { ...how, method: "POST", body, headers: { "X-Dynlab": "1" } });
